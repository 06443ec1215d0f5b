#include "tests/observe/exposition_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <set>
#include <sstream>
#include <string_view>

namespace kcs::observe::test {
namespace {

constexpr std::string_view kNameStart = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
constexpr std::string_view kDigits = "0123456789";

// Takes a line apart from its front. What is not there as the format has it fails the test.
class Line {
 public:
  explicit Line(const std::string& line) : line_(line), rest_(line) {}

  bool take(std::string_view text) {
    if (!rest_.starts_with(text)) return false;
    rest_.remove_prefix(text.size());
    return true;
  }

  void expect(std::string_view text) {
    if (!take(text)) fail("no '" + std::string(text) + "'");
  }

  // Of a metric if colons may be in it, else of a label.
  std::string name(bool colons) {
    const auto fits = [&](char c, bool first) {
      return kNameStart.find(c) != std::string_view::npos || (colons && c == ':') ||
             (!first && kDigits.find(c) != std::string_view::npos);
    };
    std::size_t size = 0;
    while (size < rest_.size() && fits(rest_[size], size == 0)) ++size;
    if (size == 0) fail("no name");
    return cut(size);
  }

  // What stands before `end`, with the escapes that may be in it.
  std::string text(char end) {
    std::size_t size = 0;
    while (size < rest_.size() && rest_[size] != end) {
      if (rest_[size] == '\\') {
        ++size;
        const std::string_view escapes = end == '"' ? "\\n\"" : "\\n";
        if (size == rest_.size() || escapes.find(rest_[size]) == std::string_view::npos) fail("a bad escape");
      }
      ++size;
    }
    return cut(std::min(size, rest_.size()));
  }

  double number() {
    const std::string digits(rest_);
    char* end = nullptr;
    const double value = std::strtod(digits.c_str(), &end);  // takes +Inf, -Inf and NaN, too
    if (digits.empty() || *end != '\0') fail("no number");
    rest_ = {};
    return value;
  }

  void fail(const std::string& what) const { ADD_FAILURE() << what << " in: " << line_; }

 private:
  std::string cut(std::size_t size) {
    const std::string taken(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return taken;
  }

  const std::string& line_;
  std::string_view rest_;
};

// One metric's buckets of one set of labels, while they are read.
struct Buckets {
  double bound = -std::numeric_limits<double>::infinity();
  double count = 0;
};

class Reader {
 public:
  std::map<std::string, double> read(const std::string& text) {
    EXPECT_TRUE(text.empty() || text.back() == '\n') << "the last line has no end";
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) read_line(line);
    for (const auto& [series, buckets] : buckets_) {
      EXPECT_EQ(buckets.bound, std::numeric_limits<double>::infinity()) << series;
    }
    return samples_;
  }

 private:
  void read_line(const std::string& text) {
    Line line(text);
    if (line.take("# HELP ")) {
      if (!helped_.insert(line.name(true)).second) line.fail("a second HELP");
      line.expect(" ");
      line.text('\n');
    } else if (line.take("# TYPE ")) {
      metric_ = line.name(true);
      line.expect(" ");
      type_ = line.text('\n');
      if (type_ != "counter" && type_ != "gauge" && type_ != "histogram") line.fail("no type");
      if (!helped_.contains(metric_)) line.fail("no HELP before the TYPE");
      if (!typed_.insert(metric_).second) line.fail("a second TYPE");
    } else {
      read_sample(text, line);
    }
  }

  void read_sample(const std::string& text, Line& line) {
    const std::string name = line.name(true);
    std::string series;  // its labels without its bucket's bound
    std::string bound;
    if (line.take("{")) {
      do {
        const std::string label = line.name(false);
        line.expect("=\"");
        const std::string value = line.text('"');
        line.expect("\"");
        if (label == "le") {
          bound = value;
        } else {
          series += label + "=" + value + ",";
        }
      } while (line.take(","));
      line.expect("}");
    }
    line.expect(" ");
    const double value = line.number();
    if (!samples_.emplace(text.substr(0, text.rfind(' ')), value).second) line.fail("a second sample");
    if (type_ == "counter" && !(value >= 0)) line.fail("a counter below zero");
    if (type_ != "histogram" && name == metric_) return;
    if (type_ == "histogram" && name == metric_ + "_bucket") {
      add_bucket(buckets_[metric_ + series], std::strtod(bound.c_str(), nullptr), value, line);
    } else if (type_ == "histogram" && name == metric_ + "_count") {
      if (buckets_[metric_ + series].count != value) line.fail("another count than that of the buckets");
    } else if (type_ != "histogram" || name != metric_ + "_sum") {
      line.fail("a sample among those of another metric");
    }
  }

  static void add_bucket(Buckets& buckets, double bound, double count, const Line& line) {
    if (!(bound > buckets.bound)) line.fail("a bound that does not rise");
    if (count < buckets.count) line.fail("a bucket that holds less than the one before");
    buckets = {bound, count};
  }

  std::string metric_;
  std::string type_;
  std::set<std::string> helped_;
  std::set<std::string> typed_;
  std::map<std::string, Buckets> buckets_;
  std::map<std::string, double> samples_;
};

}  // namespace

std::map<std::string, double> read_exposition(const std::string& text) { return Reader().read(text); }

}  // namespace kcs::observe::test
