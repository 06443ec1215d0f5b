#include "client/cli/machines_table.h"

#include <fmt/format.h>

#include <iterator>

#include "client/cli/numbers.h"
#include "client/common/names.h"

namespace kcs::cli {

std::string machines_table(const std::vector<client::AttachedMachine>& machines) {
  if (machines.empty()) return "No machine is attached; kcs-gateway attach does that, beside the machine.\n";
  static constexpr fmt::string_view kRow = "{:<22}{:<14}{:>11}{:>11}{:>11}  {}\n";
  std::string text = fmt::format(kRow, "machine", "state", "X mm", "Y mm", "Z mm", "run");
  for (const client::AttachedMachine& machine : machines) {
    const auto position = [&machine](std::size_t axis) {
      return axis < machine.position_mm.size() ? decimal(machine.position_mm[axis], 3) : "";
    };
    fmt::format_to(std::back_inserter(text), kRow, machine.name, name_of(machine.state), position(0), position(1),
                   position(2), machine.run.empty() ? "-" : machine.run);
    if (!machine.fault.empty()) text += "  " + machine.fault + "\n";
  }
  return text;
}

}  // namespace kcs::cli
