// Plans a G-code program within this process, without a service: prints the cycle time and where the tool is when.
//
//   plan_in_process FILE
#include <kcs/gcode/read_program.h>
#include <kcs/motion/sampler.h>
#include <kcs/planning/plan_path.h>

#include <exception>
#include <fstream>
#include <iostream>

namespace {

void plan_in_process(const char* file) {
  std::ifstream text(file);
  if (!text) throw std::runtime_error(std::string(file) + " cannot be opened");
  const kcs::gcode::Program program = kcs::gcode::read_program(text, {.tolerance = 0.02});

  const kcs::planning::PlanOptions options{.limits = {.velocity = {200, 200, 100},        // mm/s
                                                      .acceleration = {1000, 1000, 600},  // mm/s²
                                                      .jerk = {20000, 20000, 12000}}};    // mm/s³
  const kcs::planning::Plan plan = kcs::planning::plan(program.path, options);
  std::cout << "cycle time " << plan.summary.cycle_time << " s, " << plan.corners.size() << " corners, at most "
            << plan.summary.max_contour_error << " mm off the path\n";

  constexpr double kPeriod = 0.1;  // s
  kcs::motion::Sampler sampler(plan.trajectory, kPeriod);
  for (std::uint64_t i = 0; i < sampler.count(); ++i) {
    const kcs::motion::State state = sampler.at(i).state;
    std::cout << state.position.transpose() << " mm at " << state.velocity.norm() << " mm/s\n";
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: plan_in_process FILE\n";
    return 2;
  }
  try {
    plan_in_process(argv[1]);
  } catch (const std::exception& failure) {  // kcs::planning::InvalidInput names the line and the remedy
    std::cerr << "plan_in_process: " << failure.what() << '\n';
    return 1;
  }
}
