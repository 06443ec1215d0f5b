// The settings of the balancers in deploy/, and the program that they are for.
#pragma once

#include <string>

namespace kcs::test {

inline constexpr const char* kHaproxy = "/usr/sbin/haproxy";

// The file of deploy/`folder`.
std::string shipped_balancer(const std::string& folder);

// Replaces `from` wherever it stands. Throws std::runtime_error where it does not: the shipped file has changed, and
// what it says now would not be what is tried.
void replace(std::string& text, const std::string& from, const std::string& to);

}  // namespace kcs::test
