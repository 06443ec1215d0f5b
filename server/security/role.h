// What a caller may do.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

namespace kcs::security {

enum class Role : std::uint8_t {
  kPlan,     // have paths planned, and read one's own plans
  kStream,   // take setpoints
  kMachine,  // control machines
  kAdmin,    // everything, and with everybody's plans
};

// The role of that name in the configuration: "plan", "stream", "machine", "admin". Throws std::runtime_error that
// lists them if there is none.
Role role_named(const std::string& name);

// A set of roles.
class Roles {
 public:
  constexpr Roles() = default;
  constexpr Roles(std::initializer_list<Role> roles) {
    for (const Role role : roles) add(role);
  }

  constexpr void add(Role role) { bits_ |= 1U << static_cast<unsigned>(role); }
  constexpr bool include(Roles others) const { return (others.bits_ & ~bits_) == 0; }

 private:
  unsigned bits_ = 0;
};

// "plan and stream".
std::string names_of(Roles roles);

}  // namespace kcs::security
