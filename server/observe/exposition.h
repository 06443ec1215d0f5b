// Figures as Prometheus reads them: the text exposition format, version 0.0.4.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kcs::observe {

inline constexpr const char* kExpositionContentType = "text/plain; version=0.0.4; charset=utf-8";

// What a metric is called and what it says.
struct Description {
  std::string name;  // kcs_…, with its base unit (_seconds, _bytes), a counter's with _total
  std::string help;
  std::vector<std::string> labels = {};  // their names
};

// Writes the samples of one metric with one set of labels. Holds references to what it is made from.
class SampleWriter {
 public:
  // label_values: as many as the description has labels.
  SampleWriter(std::string& text, const Description& description, const std::vector<std::string>& label_values)
      : text_(text), description_(description), label_values_(label_values) {}

  void add(double value) { add("", value); }
  void add(std::uint64_t value) { add("", value); }
  // A sample whose name ends in `suffix`.
  void add(std::string_view suffix, double value);
  void add(std::string_view suffix, std::uint64_t value);
  // How many values of a histogram are at most `bound`, which may be infinity.
  void add_bucket(double bound, std::uint64_t count);

 private:
  void add(std::string_view suffix, std::string_view bound, std::string_view value);

  std::string& text_;
  const Description& description_;
  const std::vector<std::string>& label_values_;
};

// Writes what comes before the samples of a metric. type: "counter", "gauge" or "histogram".
void write_header(std::string& text, const Description& description, std::string_view type);

// Throws std::logic_error unless Prometheus takes the metric's name and those of its labels.
void require_names(const Description& description);

}  // namespace kcs::observe
