#include "server/gcode/parameters.h"

#include <algorithm>

#include "server/gcode/cap_reached.h"
#include "server/gcode/system_parameters.h"

namespace kcs::gcode {

double Parameters::value(const Parameter& parameter, Place place) const {
  if (is_of_machine(parameter)) return value_of_machine(parameter, machine_, place);
  if (const auto answer = value_of_calls(parameter)) return *answer;
  if (parameter.number != 0) {
    const auto index = static_cast<std::size_t>(parameter.number);
    if (parameter.is_local()) return calls_.back().numbers[index];
    return index < numbers_.size() ? numbers_[index] : 0;
  }
  const auto found = names(parameter).find(parameter.name);
  if (found == names(parameter).end()) {
    if (calls_.size() > 1 && parameter.is_local()) {
      refuse(place, parameter.text() +
                        " is not set in this call, which has names of its own. Set it in the subroutine, hand it over "
                        "as an argument, or give it a global name (#<_" +
                        parameter.name + ">).");
    }
    refuse(place, parameter.text() + " is not set. Set it on a line before this one, and check how it is spelled.");
  }
  return found->second;
}

bool Parameters::exists(const Parameter& parameter, Place place) const {
  if (is_of_machine(parameter)) value_of_machine(parameter, machine_, place);
  return parameter.number != 0 || is_read_only(parameter) || names(parameter).contains(parameter.name);
}

void Parameters::set(const Setting& setting) {
  const Parameter& parameter = setting.parameter;
  if (is_read_only(parameter)) {
    refuse(setting.place, parameter.text() +
                              " is the machine's and cannot be set by a program. Use a number up to 5060 or a name of "
                              "your own.");
  }
  if (parameter.number == 0) {
    set_name(setting);
    return;
  }
  const auto index = static_cast<std::size_t>(parameter.number);
  if (parameter.is_local()) {
    calls_.back().numbers[index] = setting.value;
    return;
  }
  numbers_.resize(std::max(numbers_.size(), index + 1));
  numbers_[index] = setting.value;
}

void Parameters::set_name(const Setting& setting) {
  const std::string& name = setting.parameter.name;
  Names& names = setting.parameter.is_local() ? calls_.back().names : globals_;
  const auto found = names.find(name);
  if (found != names.end()) {
    found->second = setting.value;
    return;
  }
  if (name_count_ == max_names_) {
    throw CapReached({"max_names", max_names_}, setting.place,
                     "the program has more than " + std::to_string(max_names_) +
                         " named parameters (the cap max_names). Use numbered ones, such as #31.");
  }
  names.emplace(name, setting.value);
  ++name_count_;
}

void Parameters::enter(std::span<const double> arguments) {
  Locals& locals = calls_.emplace_back();
  std::copy(arguments.begin(), arguments.end(), locals.numbers.begin() + 1);
}

void Parameters::leave(std::optional<double> value) {
  name_count_ -= calls_.back().names.size();
  calls_.pop_back();
  returned_ = value;
}

std::optional<double> Parameters::value_of_calls(const Parameter& parameter) const {
  if (parameter.name == "_value") return returned_.value_or(0);
  if (parameter.name == "_value_returned") return returned_ ? 1 : 0;
  if (parameter.name == "_call_level") return calls_.size() - 1;
  return std::nullopt;
}

bool Parameters::is_read_only(const Parameter& parameter) const {
  return is_of_machine(parameter) || value_of_calls(parameter).has_value();
}

}  // namespace kcs::gcode
