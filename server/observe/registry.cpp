#include "server/observe/registry.h"

#include <stdexcept>
#include <string_view>

namespace kcs::observe {
namespace {

class Reading final : public Exposed {
 public:
  Reading(Description description, std::string_view type, std::function<double()> read)
      : Exposed(std::move(description)), type_(type), read_(std::move(read)) {}

  void expose(std::string& text) const override {
    write_header(text, description(), type_);
    SampleWriter(text, description(), {}).add(read_());
  }

 private:
  std::string_view type_;
  std::function<double()> read_;
};

}  // namespace

void Registry::read_gauge(Description description, std::function<double()> read) {
  add(std::make_unique<Reading>(std::move(description), Gauge::kType, std::move(read)));
}

void Registry::read_counter(Description description, std::function<double()> read) {
  add(std::make_unique<Reading>(std::move(description), Counter::kType, std::move(read)));
}

std::string Registry::exposition() const {
  std::string text;
  const std::lock_guard lock(mutex_);
  for (const auto& metric : metrics_) metric->expose(text);
  return text;
}

void Registry::add(std::unique_ptr<Exposed> metric) {
  require_names(metric->description());
  const std::lock_guard lock(mutex_);
  for (const auto& other : metrics_) {
    if (other->description().name == metric->description().name) {
      throw std::logic_error("the metric " + metric->description().name + " is there already");
    }
  }
  metrics_.push_back(std::move(metric));
}

}  // namespace kcs::observe
