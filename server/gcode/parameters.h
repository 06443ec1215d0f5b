// The values of a program's parameters.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/gcode/parameter.h"
#include "server/gcode/place.h"

namespace kcs::gcode {

class Interpreter;

// The program's own parameters, and those with which it asks the machine (system_parameters.h) and its calls:
//   #<_value>, #<_value_returned>   what the last subroutine returned, and 1 or 0 for whether it did; 0 before
//   #<_call_level>                  how many calls are running
class Parameters {
 public:
  // `machine` must outlive the parameters. max_names: cap on the named ones.
  Parameters(const Interpreter& machine, std::size_t max_names) : machine_(machine), max_names_(max_names) {}

  // A number that was never set is 0. Refuses, naming `place`, a name that was never set, and what kcs cannot know of
  // the machine.
  double value(const Parameter& parameter, Place place) const;

  // Whether it can be read: any number, but only a name that is set. Refuses what kcs cannot know of the machine.
  bool exists(const Parameter& parameter, Place place) const;

  // Refuses those that the program can only read, and a name too many.
  void set(const Setting& setting);

  // A call begins: its own #1, #2... are `arguments`, at most kLocalParameters; the others up to that number are 0, and
  // it has no names yet.
  void enter(std::span<const double> arguments);
  // The call ends, and the caller's own parameters are back. `value`: what it returns.
  void leave(std::optional<double> value);

 private:
  using Names = std::unordered_map<std::string, double>;
  struct Locals {
    std::array<double, kLocalParameters + 1> numbers{};  // by number; [0] is not used
    Names names;
  };

  std::optional<double> value_of_calls(const Parameter& parameter) const;
  bool is_read_only(const Parameter& parameter) const;
  const Names& names(const Parameter& parameter) const { return parameter.is_local() ? calls_.back().names : globals_; }
  void set_name(const Setting& setting);

  const Interpreter& machine_;
  std::size_t max_names_;
  std::size_t name_count_ = 0;    // of all calls together, and global
  std::vector<double> numbers_;   // by number, up to the highest that was set; those of calls are not used
  Names globals_;                 // with '_' in front
  std::vector<Locals> calls_{1};  // of the main program, and of every call that is running
  std::optional<double> returned_;
};

}  // namespace kcs::gcode
