#include "server/observe/exposition.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace kcs::observe {
namespace {

std::string number(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "+Inf" : "-Inf";
  return fmt::format("{}", value);  // as many digits as it takes to read the same number again
}

void append_escaped(std::string& text, std::string_view value, bool with_quotes) {
  for (const char character : value) {
    if (character == '\n') {
      text += "\\n";
    } else {
      if (character == '\\' || (with_quotes && character == '"')) text += '\\';
      text += character;
    }
  }
}

void append_label(std::string& text, std::string_view name, std::string_view value) {
  text += text.back() == '{' ? "" : ",";
  text += name;
  text += "=\"";
  append_escaped(text, value, true);
  text += '"';
}

bool is_name(std::string_view name, std::string_view punctuation) {
  const auto is_letter = [punctuation](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || punctuation.find(c) != std::string_view::npos;
  };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return !name.empty() && is_letter(name.front()) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return is_letter(c) || is_digit(c); });
}

}  // namespace

void SampleWriter::add(std::string_view suffix, double value) { add(suffix, "", number(value)); }

void SampleWriter::add(std::string_view suffix, std::uint64_t value) { add(suffix, "", fmt::format("{}", value)); }

void SampleWriter::add_bucket(double bound, std::uint64_t count) {
  add("_bucket", number(bound), fmt::format("{}", count));
}

void SampleWriter::add(std::string_view suffix, std::string_view bound, std::string_view value) {
  text_ += description_.name;
  text_ += suffix;
  if (!label_values_.empty() || !bound.empty()) {
    text_ += '{';
    for (std::size_t i = 0; i < label_values_.size(); ++i)
      append_label(text_, description_.labels[i], label_values_[i]);
    if (!bound.empty()) append_label(text_, "le", bound);
    text_ += '}';
  }
  fmt::format_to(std::back_inserter(text_), " {}\n", value);
}

void write_header(std::string& text, const Description& description, std::string_view type) {
  fmt::format_to(std::back_inserter(text), "# HELP {} ", description.name);
  append_escaped(text, description.help, false);
  fmt::format_to(std::back_inserter(text), "\n# TYPE {} {}\n", description.name, type);
}

void require_names(const Description& description) {
  bool fine = is_name(description.name, "_:");
  for (const std::string& label : description.labels) {
    fine = fine && is_name(label, "_") && !label.starts_with("__") && label != "le";
  }
  if (!fine) throw std::logic_error("\"" + description.name + "\" or one of its labels is no name for Prometheus");
}

}  // namespace kcs::observe
