// Setpoints in the batches of the contract.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "server/motion/path.h"
#include "server/motion/setpoint.h"
#include "server/planning/marker.h"
#include "server/service/violations.h"

namespace kcs::service {

inline constexpr double kMinPeriod = 1e-5, kMaxPeriod = 10;  // s
inline constexpr double kMostSetpoints = 9007199254740992;   // 2^53: up to here i × period has an exact i
inline constexpr std::uint32_t kBatchSize = 4096, kMaxBatchSize = 32768;

// Writes the channels that a client asked for, column by column.
class SetpointColumns {
 public:
  // Request: a message with the fields `channels` and `batch_size`; `parent` is what comes before their names. Throws
  // planning::InvalidInput with all that is wrong with them.
  template <typename Request>
  SetpointColumns(const Request& request, const std::string& parent, std::size_t axes,
                  std::uint32_t usual_batch_size = kBatchSize)
      : axes_(axes), batch_size_(request.has_batch_size() ? request.batch_size() : usual_batch_size) {
    Violations violations;
    check_batch_size(parent, violations);
    for (int i = 0; i < request.channels_size(); ++i) add_channel(request.channels(i), parent, i, violations);
    violations.refuse();
  }

  // Setpoints in a batch, at most.
  std::uint64_t batch_size() const { return batch_size_; }
  // Whether places on the path are wanted.
  bool has_places() const { return has_path_position_ || has_segment_ || has_line_; }

  // Gives `batch` room for `size` setpoints, and takes its markers away. Giving the same batch again saves allocations.
  void begin(v1::SetpointBatch& batch, std::uint64_t size);
  // Sets setpoint `index` of the batch, and the place on the path that belongs to it.
  void set(std::uint64_t index, const motion::Setpoint& setpoint);
  void set(std::uint64_t index, const motion::Place& place, const motion::Path& path);
  // Leaves the first `size` setpoints in the batch.
  static void cut(v1::SetpointBatch& batch, std::uint64_t size);

 private:
  using Numbers = std::array<double*, 3>;  // of each axis' column

  void check_batch_size(const std::string& parent, Violations& violations) const;
  void add_channel(v1::Channel channel, const std::string& parent, int index, Violations& violations);

  std::size_t axes_;
  std::uint64_t batch_size_;
  bool has_velocity_ = false;
  bool has_acceleration_ = false;
  bool has_jerk_ = false;
  bool has_path_position_ = false;
  bool has_segment_ = false;
  bool has_line_ = false;
  Numbers position_{}, velocity_{}, acceleration_{}, jerk_{};
  double* path_position_ = nullptr;
  std::uint64_t* segment_ = nullptr;
  std::uint32_t* line_ = nullptr;
};

// The first setpoint that is not before a marker.
std::uint64_t setpoint_of(const planning::MarkerAt& marker, double period);
void add_marker(std::uint64_t setpoint, const planning::Marker& marker, v1::SetpointBatch& batch);

}  // namespace kcs::service
