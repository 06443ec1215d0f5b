#include "tests/soak/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>

namespace kcs::soak {
namespace {

class Cook {
 public:
  explicit Cook(const Recipe& recipe) : random_(recipe.seed) {
    // The length of the first move: a request of its own for each seed.
    first_step_ = 1 + 1e-6 * static_cast<double>(recipe.seed % 1'000'000);
    switch (recipe.size) {
      case Size::kSmall:
        segments_ = whole(3, 40), longest_ = 10;
        break;
      case Size::kMedium:
        segments_ = whole(100, 500), longest_ = 1;
        break;
      case Size::kLarge:
        segments_ = whole(2000, 5000), longest_ = 0.5;
        break;
    }
  }

  v1::CreatePlanRequest options() {
    v1::CreatePlanRequest message;
    v1::PlanOptions& options = *message.mutable_options();
    v1::Machine& machine = *options.mutable_machine();
    machine.set_name(machine_name(whole(0, kMachines - 1)));
    machine.set_axes(3);
    for (int axis = 0; axis < 3; ++axis) {
      machine.add_velocity_mm_s(200);
      machine.add_acceleration_mm_s2(number(1000, 5000));
      machine.add_jerk_mm_s3(1e5);
    }
    options.set_tolerance_mm(number(0.005, 0.1));
    return message;
  }

  void add_points(std::vector<v1::CreatePlanRequest>& messages) {
    double at[] = {0, 0, 0};
    for (int done = 0; done < segments_;) {
      v1::PathChunk& chunk = *messages.emplace_back().mutable_path();
      if (done == 0) chunk.mutable_points_mm()->Add(std::begin(at), std::end(at));
      for (const int end = std::min(segments_, done + whole(1, 2000)); done < end; ++done) {
        for (double& axis : at) axis += done == 0 ? first_step_ : number(-longest_, longest_);
        chunk.mutable_points_mm()->Add(std::begin(at), std::end(at));
      }
      chunk.add_feed_mm_s(100);
    }
  }

  void add_program(std::vector<v1::CreatePlanRequest>& messages) {
    std::string program = fmt::format("G21 G90 G17 G91.1\nG1 X{:.7f} F6000\n", first_step_);
    for (int i = 0; i < segments_; ++i) {
      const double x = number(-longest_, longest_), y = number(-longest_, longest_);
      if (whole(0, 9) == 0) {  // half a turn that ends where the line would
        program += fmt::format("G91 G3 X{:.4f} Y{:.4f} I{:.5f} J{:.5f}\n", 2 * x, 2 * y, x, y);
      } else {
        program += fmt::format("G91 G1 X{:.4f} Y{:.4f} Z{:.4f}\n", x, y, number(-1, 1));
      }
    }
    for (std::string_view rest = program; !rest.empty();) {
      const auto piece = std::min(rest.size(), static_cast<std::size_t>(whole(1, 60'000)));
      messages.emplace_back().set_gcode(rest.data(), piece);
      rest.remove_prefix(piece);
    }
  }

  int whole(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }

 private:
  double number(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }

  std::mt19937_64 random_;
  double first_step_ = 1;  // mm
  int segments_ = 0;
  double longest_ = 1;  // mm, of each axis
};

}  // namespace

std::vector<v1::CreatePlanRequest> messages(const Recipe& recipe) {
  Cook cook(recipe);
  std::vector<v1::CreatePlanRequest> messages = {cook.options()};
  if (cook.whole(0, 1) == 0) {
    cook.add_points(messages);
  } else {
    cook.add_program(messages);
  }
  return messages;
}

std::vector<v1::PlanLiveRequest> live_messages(const Recipe& recipe, double period) {
  std::vector<v1::PlanLiveRequest> live;
  for (v1::CreatePlanRequest& message : messages(recipe)) {
    v1::PlanLiveRequest& piece = live.emplace_back();
    if (message.has_options()) {
      piece.mutable_options()->Swap(message.mutable_options());
      piece.mutable_output()->set_period_s(period);
    } else if (message.has_path()) {
      piece.mutable_path()->Swap(message.mutable_path());
    } else {
      piece.mutable_gcode()->swap(*message.mutable_gcode());
    }
  }
  return live;
}

std::string machine_name(int machine) { return fmt::format("soak {}", machine); }

}  // namespace kcs::soak
