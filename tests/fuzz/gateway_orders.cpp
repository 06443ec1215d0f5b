// Any bytes as what a server orders a machine to do: whatever comes, the drives are commanded nothing but motion inside
// the machine's limits.
#include <kcs/v1/machine.pb.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/null_sink.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>

#include "client/gateway/machine/batch_check.h"
#include "client/gateway/machine/feeder.h"
#include "client/gateway/machine/player_memory.h"
#include "client/gateway/player/player.h"

namespace {

using namespace kcs;

constexpr double kPeriod = 1e-3, kVelocity = 100, kAcceleration = 1000, kJerk = 1e5, kMargin = 1 + 1e-4;

void require(bool condition) {
  if (!condition) std::abort();
}

kcs_player_profile profile() {
  kcs_player_profile profile{.axes = 2, .unused = 0, .period_s = kPeriod};
  for (int axis = 0; axis < 2; ++axis) {
    profile.velocity_mm_s[axis] = kVelocity;
    profile.acceleration_mm_s2[axis] = kAcceleration;
    profile.jerk_mm_s3[axis] = kJerk;
    profile.following_error_mm[axis] = 1;
  }
  return profile;
}

std::shared_ptr<spdlog::logger> quiet_log() {
  return std::make_shared<spdlog::logger>("", std::make_shared<spdlog::sinks::null_sink_mt>());
}

// A machine that is switched on and stands at 0.
class Machine {
 public:
  Machine() {
    require(kcs_player_start(player_.get(), memory_.get()));
    input_.enable = true;
    play(10);
  }

  // No fuzzing would find the checksum that fits: batches get it.
  void take(v1::AttachMachineResponse order) {
    if (order.has_batch()) order.mutable_batch()->set_checksum(gateway::checksum_of(order.batch()));
    feeder_.take(order);
    play(100);
    feeder_.report();
  }

 private:
  void play(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      feeder_.step();
      tick();
    }
  }

  void tick() {
    kcs_player_output output;
    kcs_player_tick(player_.get(), &input_, &output);
    require(output.marker_count <= KCS_PLAYER_MARKERS);
    for (int axis = 0; axis < 2; ++axis) {
      const double position = output.command_mm[axis];
      require(std::isfinite(position));
      const double velocity = (position - position_[axis]) / kPeriod;
      const double acceleration = (velocity - velocity_[axis]) / kPeriod;
      const double jerk = (acceleration - acceleration_[axis]) / kPeriod;
      // The last digits of a position far out are no motion.
      const double rounding = 16 * std::abs(position) * 0x1p-52;
      require(std::abs(velocity) <= kVelocity * kMargin + rounding / kPeriod);
      require(std::abs(acceleration) <= kAcceleration * kMargin + rounding / (kPeriod * kPeriod));
      require(std::abs(jerk) <= kJerk * kMargin + rounding / (kPeriod * kPeriod * kPeriod));
      position_[axis] = input_.actual_mm[axis] = position;
      velocity_[axis] = velocity;
      acceleration_[axis] = acceleration;
    }
  }

  gateway::PlayerMemory memory_ = gateway::make_player_memory(profile());
  std::unique_ptr<kcs_player> player_ = std::make_unique<kcs_player>();
  gateway::Feeder feeder_{*memory_, {.machine = "machines/mill", .commit_s = 0.02}, quiet_log()};
  kcs_player_input input_{};
  double position_[2]{}, velocity_[2]{}, acceleration_[2]{};
};

}  // namespace

// One response after the other, each behind its length in two bytes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Machine machine;
  for (std::size_t at = 0; at + 2 <= size;) {
    const std::size_t length = std::min<std::size_t>(data[at] + 256u * data[at + 1], size - at - 2);
    at += 2;
    v1::AttachMachineResponse order;
    if (order.ParseFromArray(data + at, static_cast<int>(length))) machine.take(std::move(order));
    at += length;
  }
  return 0;
}
