// Requests of every kind, each made again from its seed.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <cstdint>
#include <vector>

namespace kcs::soak {

enum class Size { kSmall, kMedium, kLarge };  // some ten, some hundred, some thousand segments

// What a request is made from. Different seeds give different requests.
struct Recipe {
  std::uint64_t seed = 0;
  Size size = Size::kSmall;
};

// The messages of CreatePlan: points or a G-code program, cut anywhere; the options come first.
std::vector<v1::CreatePlanRequest> messages(const Recipe& recipe);

// The same path for PlanLive, with a setpoint every `period`, s.
std::vector<v1::PlanLiveRequest> live_messages(const Recipe& recipe, double period);

// Machine names of all requests are those from 0 to kMachines − 1.
inline constexpr int kMachines = 3;
std::string machine_name(int machine);

}  // namespace kcs::soak
