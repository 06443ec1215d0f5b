#include "server/http/plan_query.h"

#include <fmt/format.h>

#include <charconv>
#include <set>
#include <string_view>
#include <vector>

namespace kcs::http {
namespace {

using Query = std::multimap<std::string, std::string>;

constexpr std::string_view kParameters =
    "machine, velocity, acceleration, jerk, rapid, tolerance, feed and start are known";

double number_of(const std::string& parameter, std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw InvalidQuery(parameter, fmt::format("\"{}\" is no number: give one like 0.02", text));
  }
  return number;
}

std::vector<double> numbers_of(const std::string& parameter, std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t end = 0; end != std::string_view::npos; text.remove_prefix(end + 1)) {
    end = text.find(',');
    numbers.push_back(number_of(parameter, text.substr(0, end)));
    if (end == std::string_view::npos) break;
  }
  return numbers;
}

void require_known(const Query& query) {
  static const std::set<std::string, std::less<>> kKnown = {"machine", "velocity",  "acceleration", "jerk",
                                                            "rapid",   "tolerance", "feed",         "start"};
  for (const auto& [parameter, value] : query) {
    if (!kKnown.contains(parameter)) throw InvalidQuery(parameter, fmt::format("is unknown: {}", kParameters));
    if (query.count(parameter) > 1) throw InvalidQuery(parameter, "is there twice: give it once");
  }
}

v1::Machine named_machine(const std::string& name, const Machines& machines) {
  const auto found = machines.find(name);
  if (found != machines.end()) return found->second;
  std::string names;
  for (const auto& [known, machine] : machines) names += (names.empty() ? "" : ", ") + known;
  throw InvalidQuery("machine",
                     fmt::format("\"{}\" is unknown: name one of {}, or give velocity, acceleration and jerk", name,
                                 names.empty() ? "none" : names));
}

}  // namespace

v1::PlanOptions options_of(const Query& query, const Machines& machines) {
  require_known(query);
  const auto given = [&query](const char* parameter) -> const std::string* {
    const auto found = query.find(parameter);
    return found == query.end() ? nullptr : &found->second;
  };
  v1::PlanOptions options;
  v1::Machine& machine = *options.mutable_machine();
  if (const std::string* name = given("machine")) machine = named_machine(*name, machines);
  const auto set_limit = [&](const char* parameter, google::protobuf::RepeatedField<double>& limit) {
    if (const std::string* text = given(parameter)) {
      const std::vector<double> numbers = numbers_of(parameter, *text);
      limit.Assign(numbers.begin(), numbers.end());
    } else if (limit.empty()) {
      throw InvalidQuery(parameter, "is missing: name a machine, or give velocity, acceleration and jerk of its axes");
    }
  };
  set_limit("velocity", *machine.mutable_velocity_mm_s());
  set_limit("acceleration", *machine.mutable_acceleration_mm_s2());
  set_limit("jerk", *machine.mutable_jerk_mm_s3());
  machine.set_axes(static_cast<std::uint32_t>(machine.velocity_mm_s_size()));
  if (const std::string* text = given("rapid")) machine.set_rapid_mm_s(number_of("rapid", *text));
  if (const std::string* text = given("tolerance")) options.set_tolerance_mm(number_of("tolerance", *text));
  if (const std::string* text = given("feed")) options.set_feed_mm_s(number_of("feed", *text));
  if (const std::string* text = given("start")) {
    const std::vector<double> start = numbers_of("start", *text);
    options.mutable_start_mm()->Assign(start.begin(), start.end());
  }
  return options;
}

}  // namespace kcs::http
