// Asks a server how long a G-code program takes on a machine, where it loses time, and for its setpoints.
//
//   plan_a_path HOST:PORT FILE
#include <kcs/client/machine_profile.h>
#include <kcs/client/planner.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <iostream>
#include <vector>

namespace client = kcs::client;

namespace {

void plan_a_path(const char* address, const char* file) {
  client::Planner planner(address);
  std::ifstream program(file);
  if (!program) throw std::runtime_error(std::string(file) + " cannot be opened");

  const client::PlanOptions options{.machine = client::find_machine("router"), .tolerance_mm = 0.02};
  const client::Plan plan = planner.plan_gcode(program, options);
  std::cout << "cycle time " << plan.summary.cycle_time_s << " s, " << plan.summary.corner_count << " corners, at most "
            << plan.summary.max_contour_error_mm << " mm off the path\n";

  const std::vector<client::Corner> corners = planner.corners(plan.name);
  const auto slowest = std::max_element(corners.begin(), corners.end(),
                                        [](const auto& a, const auto& b) { return a.time_lost_s < b.time_lost_s; });
  if (slowest != corners.end()) {
    std::cout << "line " << slowest->line << " costs most: " << slowest->time_lost_s << " s\n";
  }

  // A setpoint every millisecond, in batches; the stream ends with its object, whatever is thrown meanwhile.
  std::uint64_t setpoints = 0;
  client::SetpointStream stream = planner.stream_setpoints(plan.name, {.period_s = 0.001});
  for (client::SetpointBatch batch; stream.next(batch);) setpoints += batch.size();
  std::cout << setpoints << " setpoints\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: plan_a_path HOST:PORT FILE\n";
    return 2;
  }
  try {
    plan_a_path(argv[1], argv[2]);
  } catch (const client::Error& refused) {
    std::cerr << "plan_a_path: " << refused.code() << ": " << refused.what() << '\n';
    for (const auto& [field, description] : refused.violations()) std::cerr << field << ": " << description << '\n';
    return 1;
  } catch (const std::exception& failure) {
    std::cerr << "plan_a_path: " << failure.what() << '\n';
    return 1;
  }
}
