// Setpoints of a plan as they arrive from the server.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace kcs::client {

// What a setpoint carries beside the position.
enum class Channel { kVelocity, kAcceleration, kJerk, kPathPosition, kSegment, kLine };

struct StreamOptions {
  double period_s = 0.001;        // between two setpoints, 1e-5 to 10
  std::uint64_t first_index = 0;  // first setpoint wanted
  std::vector<Channel> channels;  // wanted beside the position
  // Setpoints in a batch, 1 to 32768: small for latency, large for throughput. None: 4096; with lead_s those of 0.1 s,
  // at most 4096.
  std::optional<std::uint32_t> batch_size;
  std::optional<std::uint64_t> last_index;  // last one wanted, not before first_index; none: to the end of the path
  // Real-time pace: how long before the time of its first setpoint a batch is sent, 0 to 3600; the first one's time is
  // that of the call. None: as fast as next() is called.
  std::optional<double> lead_s;
};

// The values of one quantity: columns[axis][k] is that of setpoint first_index + k.
using Columns = std::vector<std::vector<double>>;

// Consecutive setpoints. Setpoint i belongs to the time i × period.
struct SetpointBatch {
  std::uint64_t first_index = 0;
  Columns position_mm;
  Columns velocity_mm_s;  // this and the next five: empty unless asked for
  Columns acceleration_mm_s2;
  Columns jerk_mm_s3;
  // The place of the programmed path that the tool is at: the way from its start to there, which never falls, the
  // segment that it lies on, from 0, and the line of the program that this comes from, from 1 (0: not known).
  std::vector<double> path_position_mm;
  std::vector<std::uint64_t> segment;
  std::vector<std::uint32_t> line;
  bool end_of_path = false;          // the last setpoint of this batch is the exact end of the path
  std::uint64_t setpoint_count = 0;  // of the whole plan at this period

  // Number of setpoints in this batch.
  std::size_t size() const { return position_mm.empty() ? 0 : position_mm.front().size(); }
};

// A running stream of setpoints; made by Planner::stream_setpoints. Destroying it cancels it, so the server stops
// computing as soon as nobody reads. The server sends no faster than next() is called.
class SetpointStream {
 public:
  class Call;  // the running call; known to the library alone
  explicit SetpointStream(std::unique_ptr<Call> call);
  SetpointStream(SetpointStream&&) noexcept;
  SetpointStream& operator=(SetpointStream&&) noexcept;
  ~SetpointStream();

  // Waits for the next batch and puts it into `batch`, reusing its memory. False when the stream has ended after its
  // last batch. Where the server goes away meanwhile it goes on from the next setpoint with whichever server is there,
  // unless it has a pace (lead_s) or Connection::tries_again is false. Throws Error if it broke off; a new stream can
  // take it up at the next index.
  bool next(SetpointBatch& batch);

 private:
  std::unique_ptr<Call> call_;
};

}  // namespace kcs::client
