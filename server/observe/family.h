// A metric with labels: one number for each set of their values.
#pragma once

#include <map>
#include <mutex>
#include <shared_mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "server/observe/exposition.h"

namespace kcs::observe {

// What has a name and a place among the figures of a registry.
class Exposed {
 public:
  explicit Exposed(Description description) : description_(std::move(description)) {}
  virtual ~Exposed() = default;
  Exposed(const Exposed&) = delete;
  Exposed& operator=(const Exposed&) = delete;

  const Description& description() const { return description_; }

  // Adds its lines of the exposition to `text`.
  virtual void expose(std::string& text) const = 0;

 private:
  const Description description_;
};

// Metric: Counter, Gauge or Histogram. Safe for use by many threads at once. Every set of values that was ever used is
// shown for ever: label by what has few values, never by what a client makes up.
template <typename Metric>
class Family final : public Exposed {
 public:
  using Exposed::Exposed;

  // The metric with these values of the labels, in their order. It lives as long as the family: where it is used often,
  // keep the reference. Throws std::logic_error if there are not as many values as labels.
  Metric& with(const std::vector<std::string>& values) {
    if (values.size() != description().labels.size()) {
      throw std::logic_error(description().name + " has another number of labels");
    }
    {
      const std::shared_lock lock(mutex_);
      if (const auto found = metrics_.find(values); found != metrics_.end()) return found->second;
    }
    const std::lock_guard lock(mutex_);
    return metrics_[values];
  }

  void expose(std::string& text) const override {
    write_header(text, description(), Metric::kType);
    const std::shared_lock lock(mutex_);
    for (const auto& [values, metric] : metrics_) metric.expose(SampleWriter(text, description(), values));
  }

 private:
  mutable std::shared_mutex mutex_;
  std::map<std::vector<std::string>, Metric> metrics_;
};

}  // namespace kcs::observe
