#include "server/motion/trajectory.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <thread>
#include <vector>

namespace kcs::motion {
namespace {

// A phase bit by bit.
std::vector<std::uint64_t> bits(const Phase& phase) {
  std::vector<std::uint64_t> result{phase.segments.first, phase.segments.last};
  for (const double number : {phase.start_time, phase.duration}) result.push_back(std::bit_cast<std::uint64_t>(number));
  for (const Vector& vector : {phase.start.position, phase.start.velocity, phase.start.acceleration, phase.jerk}) {
    for (const double number : vector) result.push_back(std::bit_cast<std::uint64_t>(number));
  }
  return result;
}

Trajectory packed(const std::vector<Phase>& phases) {
  Trajectory trajectory;
  for (const Phase& phase : phases) trajectory.append(phase);
  return trajectory;
}

void expect_the_same(const Trajectory& trajectory, const std::vector<Phase>& phases) {
  ASSERT_EQ(trajectory.size(), phases.size());
  std::size_t i = 0;
  for (const Phase& phase : trajectory) {
    ASSERT_EQ(bits(phase), bits(phases[i])) << "phase " << i;
    ++i;
  }
  EXPECT_EQ(i, phases.size());
}

// A motion whose phases follow one from the other, each number good to its last bits only.
class Motion {
 public:
  // axes: that move. from: the coordinate where they start, mm.
  Motion(std::size_t axes, double from) : axes_(axes) { state_.position.setConstant(from); }

  std::vector<Phase> phases(std::size_t count) {
    std::vector<Phase> result;
    Phase phase;
    for (std::size_t i = 0; i < count; ++i) {
      phase.start_time = phase.end_time();
      phase.duration = 1e-3 * (1.5 + number_(random_));
      for (std::size_t axis = 0; axis < axes_; ++axis) {
        const auto k = static_cast<Eigen::Index>(axis);
        // Towards a velocity and an acceleration of zero, and some more.
        phase.jerk[k] = -1e2 * state_.velocity[k] - 1e2 * state_.acceleration[k] + 1e5 * number_(random_);
        phase.start.position[k] = rounded(state_.position[k]);
        phase.start.velocity[k] = rounded(state_.velocity[k]);
        phase.start.acceleration[k] = rounded(state_.acceleration[k]);
      }
      phase.segments = {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i + 3)};
      result.push_back(phase);
      state_ = phase.at(phase.duration);
    }
    return result;
  }

 private:
  double rounded(double number) { return number * (1 + 8 * number_(random_) * std::numeric_limits<double>::epsilon()); }

  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> number_{-1, 1};
  std::size_t axes_;
  State state_;
};

TEST(Trajectory, GivesBackWhatWasAppended) {
  for (const double from : {0.0, 100.0, 1e6}) {
    for (const std::size_t axes : {1, 2, 3}) {
      const std::vector<Phase> phases = Motion(axes, from).phases(1'000);
      expect_the_same(packed(phases), phases);
    }
  }
}

TEST(Trajectory, GivesBackAnyNumbers) {
  std::mt19937_64 random(11);
  const std::array<double, 8> special{0.0,
                                      -0.0,
                                      std::numeric_limits<double>::quiet_NaN(),
                                      std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::denorm_min(),
                                      std::numeric_limits<double>::lowest(),
                                      1.0,
                                      -1.0};
  const auto number = [&] { return random() % 2 == 0 ? special[random() % 8] : std::bit_cast<double>(random()); };
  std::vector<Phase> phases(2'000);
  for (std::size_t i = 0; i < phases.size(); ++i) {
    Phase& phase = phases[i];
    phase.start_time = i > 0 && random() % 4 != 0 ? phases[i - 1].end_time() : number();
    phase.duration = number();
    for (Vector* vector : {&phase.start.position, &phase.start.velocity, &phase.start.acceleration, &phase.jerk}) {
      for (double& value : *vector) value = number();
    }
    phase.segments = {static_cast<std::uint32_t>(random() >> (random() % 33 + 31)),
                      static_cast<std::uint32_t>(random())};
    if (random() % 2 == 0) phase.segments.last = phase.segments.first + static_cast<std::uint32_t>(random() % 9);
  }
  expect_the_same(packed(phases), phases);
}

TEST(Trajectory, TakesFewBytes) {
  constexpr std::size_t kCount = 100'000;
  const auto bytes_a_phase = [](const std::vector<Phase>& phases) {
    return static_cast<double>(packed(phases).bytes()) / static_cast<double>(phases.size());
  };
  EXPECT_LE(bytes_a_phase(Motion(3, 100).phases(kCount)), 48);
  EXPECT_LE(bytes_a_phase(Motion(1, 100).phases(kCount)), 30);
  EXPECT_LE(bytes_a_phase(std::vector<Phase>(1)), 500);
}

TEST(Trajectory, FindsThePhaseOfATime) {
  const std::vector<Phase> phases = Motion(3, 0).phases(1'000);
  const Trajectory trajectory = packed(phases);
  Trajectory::Iterator iterator = trajectory.begin();
  std::size_t i = 0;
  for (std::size_t count = 0; count < phases.size(); ++count) {
    i = (i + 617) % phases.size();
    iterator.seek(phases[i].start_time);
    ASSERT_EQ(bits(*iterator), bits(phases[i]));
    iterator.seek(phases[i].start_time + phases[i].duration / 2);
    ASSERT_EQ(bits(*iterator), bits(phases[i]));
  }
  iterator.seek(1e9);
  EXPECT_EQ(bits(*iterator), bits(phases.back()));
  iterator.seek(-1);
  EXPECT_EQ(bits(*iterator), bits(phases.front()));
}

TEST(Trajectory, IsReadByManyThreads) {
  const std::vector<Phase> phases = Motion(3, 0).phases(10'000);
  const Trajectory trajectory = packed(phases);
  std::array<double, 4> sums{};
  const auto add = [&](double& sum) {
    for (const Phase& phase : trajectory) sum += phase.start.position.sum();
  };
  std::vector<std::jthread> threads;
  threads.reserve(sums.size());
  for (double& sum : sums) threads.emplace_back(add, std::ref(sum));
  threads.clear();
  for (const double sum : sums) EXPECT_EQ(sum, sums[0]);
}

TEST(Trajectory, IsEmptyAtFirst) {
  const Trajectory trajectory;
  EXPECT_TRUE(trajectory.empty());
  EXPECT_EQ(trajectory.duration(), 0);
  EXPECT_TRUE(trajectory.begin() == trajectory.end());
}

}  // namespace
}  // namespace kcs::motion
