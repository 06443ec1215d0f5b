// The C++ client of the planning service.
//
//   kcs::client::Planner planner("localhost:50051");
//   const kcs::client::Plan plan = planner.plan_gcode(file, options);
//   auto stream = planner.stream_setpoints(plan.name, {.period_s = 0.001});
//   for (kcs::client::SetpointBatch batch; stream.next(batch);) use(batch);
#pragma once

#include <chrono>
#include <functional>
#include <iosfwd>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "client/sdk/connection.h"
#include "client/sdk/error.h"
#include "client/sdk/live_stream.h"
#include "client/sdk/machine.h"
#include "client/sdk/plan.h"
#include "client/sdk/plan_list.h"
#include "client/sdk/setpoint_stream.h"

namespace kcs::client {

class ServerLink;  // known to kcs alone, as it is made of gRPC

// Asks a server to plan tool paths, and for the setpoints and corners of its plans. Calls may be made from several
// threads at once. Every call throws Error if the server refuses it or does not answer: "UNAVAILABLE" at the latest
// twenty seconds after the server's process or the network has fallen silent, however long the call itself may take.
//
// Planning takes as long as the path needs. A call that is given a stop token ends as soon as a stop is requested, from
// whatever thread, and throws Error ("CANCELLED").
class Planner {
 public:
  // The server at `address`, "HOST:PORT" or "unix:/path/of/socket". Does not connect yet: the first call does, and each
  // call gives up after `patience` if no server can be reached meanwhile.
  explicit Planner(const std::string& address, std::chrono::milliseconds patience = std::chrono::seconds(5));

  // The same with TLS, a token, or both. Throws std::system_error if a file cannot be read, Error ("INVALID_ARGUMENT")
  // if the connection contradicts itself, or would show its token to whoever listens on the network.
  explicit Planner(const Connection& connection);

  // A server behind a channel made elsewhere, for instance one inside this process.
  explicit Planner(const ServerLink& server);

  Planner(Planner&&) noexcept;
  Planner& operator=(Planner&&) noexcept;
  ~Planner();

  // Plans a G-code program, read from `program` in pieces as it is sent: it may be larger than the memory.
  // Waits until the plan is made and verified. Throws std::ios_base::failure if the program cannot be read.
  // A stop does not interrupt the reading of `program`.
  Plan plan_gcode(std::istream& program, const PlanOptions& options, const std::stop_token& stop = {});

  // Plans a path of points.
  Plan plan_points(const PointPath& path, const PlanOptions& options, const std::stop_token& stop = {});

  // A plan that the server keeps. Throws Error ("NOT_FOUND") if it does not.
  Plan get(const std::string& name, const std::stop_token& stop = {});

  // One page of the caller's plans, 1 to 1000 of them, those after the page that gave `page_token` (empty: the first).
  PlanPage list(const PlanFilter& filter = {}, const std::string& page_token = {}, int page_size = 100,
                const std::stop_token& stop = {});

  // Waits until a plan is there, and returns it. Tells `on_progress`, if there is one, how far it has come. Throws
  // Error with the reason if its request is refused.
  Plan await(const std::string& name, const std::function<void(const PlanProgress&)>& on_progress = {},
             const std::stop_token& stop = {});

  // Makes the server forget a plan. Throws Error ("NOT_FOUND") if it does not keep it.
  void remove(const std::string& name, const std::stop_token& stop = {});

  // How every corner of a plan is taken and what it costs, in the order of the path.
  std::vector<Corner> corners(const std::string& name, const std::stop_token& stop = {});

  // Starts to sample a plan. The planner may go before the stream does. The stop token holds for the whole stream: a
  // next() that waits in another thread throws Error ("CANCELLED").
  SetpointStream stream_setpoints(const std::string& name, const StreamOptions& options,
                                  const std::stop_token& stop = {});

  // Starts to plan a path that is still to come, see LiveStream. The planner may go before the stream does. The stop
  // token holds for the whole stream.
  LiveStream plan_live(const PlanOptions& options, const LiveOptions& output, const std::stop_token& stop = {});

 private:
  class Link;
  std::unique_ptr<Link> link_;
};

}  // namespace kcs::client
