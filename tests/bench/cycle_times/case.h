// What is planned by kcs and by LinuxCNC, and what is aimed at.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace kcs::bench {

struct Case {
  std::string name;
  std::string file;         // a G-code program
  double acceleration = 0;  // of every axis, mm/s²
  double tolerance = 0;     // mm
  bool inches = false;      // the program's unit, though it does not say so
  double s_curve = 0;       // s, that LinuxCNC's newest S-curve planner took, J = 5e4, measured in November 2026

  struct Jerk {
    double jerk = 0;             // of every axis, mm/s³
    std::optional<double> goal;  // s
  };
  std::vector<Jerk> jerks;
};

// Throws std::runtime_error if the file cannot be read, nlohmann::json::exception if it is not as it should be.
std::vector<Case> load_cases(const std::string& file);

}  // namespace kcs::bench
