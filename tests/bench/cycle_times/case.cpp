#include "tests/bench/cycle_times/case.h"

#include <nlohmann/json.hpp>

#include "tests/bench/program.h"

namespace kcs::bench {
namespace {

Case::Jerk jerk_of(const nlohmann::json& plan, double s_curve) {
  Case::Jerk jerk{.jerk = plan.at("jerk")};
  if (plan.contains("goal")) jerk.goal = plan["goal"].get<double>();
  if (plan.contains("goal_of_s_curve")) jerk.goal = plan["goal_of_s_curve"].get<double>() * s_curve;
  return jerk;
}

}  // namespace

std::vector<Case> load_cases(const std::string& file) {
  std::vector<Case> cases;
  for (const auto& entry : nlohmann::json::parse(text_of(file))) {
    Case& one = cases.emplace_back(Case{.name = entry.at("name"),
                                        .file = entry.at("file"),
                                        .acceleration = entry.at("acceleration"),
                                        .tolerance = entry.at("tolerance"),
                                        .inches = entry.value("inches", false),
                                        .s_curve = entry.at("s_curve_2026_11")});
    for (const auto& plan : entry.at("plans")) one.jerks.push_back(jerk_of(plan, one.s_curve));
  }
  return cases;
}

}  // namespace kcs::bench
