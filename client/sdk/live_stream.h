// A path that is planned while it is sent.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "client/sdk/plan.h"
#include "client/sdk/setpoint_stream.h"

namespace kcs::client {

// What is wanted of a path that is planned live.
struct LiveOptions {
  double period_s = 0.001;          // between two setpoints, 1e-5 to 10
  std::vector<Channel> channels;    // wanted beside the position
  std::uint32_t batch_size = 4096;  // setpoints in a batch at most, 1 to 32768; fewer come when no more are settled
  bool corners = false;             // whether they are wanted as well
};

// A call that takes a path and gives its setpoints; made by Planner::plan_live. The sending functions belong to one
// thread, the receiving ones to another: send() waits while the server waits with setpoints that nobody takes. (One
// thread can do both where the path and its setpoints are short: some thousands.) Destroying the stream cancels it;
// nobody may be inside one of its functions then.
class LiveStream {
 public:
  class Call;  // the running call; known to the library alone
  explicit LiveStream(std::unique_ptr<Call> call);
  LiveStream(LiveStream&&) noexcept;
  LiveStream& operator=(LiveStream&&) noexcept;
  ~LiveStream();

  // Send the next piece of the path, cut anywhere: of a G-code program, or points, with what belongs to them. One kind
  // a stream. False when the server takes no more of it: next() says why. Throws Error if the arrays of a piece do not
  // fit its points.
  bool send(std::string_view gcode);
  bool send(const PointPath& piece);
  // The path is complete.
  void end_path();

  // Waits for the next setpoints and puts them into `batch`, reusing its memory; their setpoint_count is 0 before the
  // end of the path. False when the stream has ended after its last batch. Throws Error if the server refused the path,
  // or if the stream broke off.
  bool next(SetpointBatch& batch);
  // The corners that came since the last call, in the order of the path; none if they were not asked for.
  std::vector<Corner> take_corners();
  // After the last batch. The server does not keep it.
  const Plan& plan() const;

 private:
  std::unique_ptr<Call> call_;
};

}  // namespace kcs::client
