// The C++ client of the machine service: runs plans on machines, and operates them.
//
//   kcs::client::Machines machines(connection);
//   const kcs::client::Run run = machines.run_plan("machines/mill", plan.name);
//   machines.hold(run.name);
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "client/sdk/connection.h"
#include "client/sdk/error.h"
#include "client/sdk/run.h"

namespace kcs::client {

class ServerLink;  // known to kcs alone, as it is made of gRPC

// Runs are meant by their names. Calls may be made from several threads at once. Every call throws Error as those of
// Planner do: "NOT_FOUND" for a run or machine that the server does not know, "FAILED_PRECONDITION", with the reason,
// for what cannot be done now.
class Machines {
 public:
  // Does not connect yet. Throws std::system_error if a file cannot be read, Error ("INVALID_ARGUMENT") if the
  // connection contradicts itself, or would show its token to whoever listens on the network.
  explicit Machines(const Connection& connection);

  // A server behind a channel made elsewhere, for instance one inside this process.
  explicit Machines(const ServerLink& server);

  Machines(Machines&&) noexcept;
  Machines& operator=(Machines&&) noexcept;
  ~Machines();

  // Those that are attached to this server.
  std::vector<AttachedMachine> list();

  // Begins a run; the caller becomes its controller. The plan must start at rest where the machine stands, and its
  // limits must be inside the machine's. The override, 0 to 200 %, is 100 % unless it is given. Takes as long as
  // planning if the server has to make the plan again.
  Run run_plan(const std::string& machine, const std::string& plan, std::optional<double> feed_override_percent = {});

  Run get(const std::string& run);
  // Brings the machine to rest on the path: at once, while the call returns before it rests.
  Run hold(const std::string& run);
  // Goes on from where it is held. take_over: become the controller if somebody else is.
  Run resume(const std::string& run, bool take_over = false);
  // Brings the machine to rest on the path, and ends the run.
  Run abort(const std::string& run);
  // 0 to 200 % of the planned pace; 0 brings the machine to rest without holding it.
  Run set_feed_override(const std::string& run, double percent, bool take_over = false);

  // Hands `on_change` the run as it is, then after every change, at most twenty times a second. Returns it once it is
  // over; a requested stop ends the watching with Error ("CANCELLED"), and leaves the run alone. What `on_change`
  // throws ends it too.
  Run watch(const std::string& run, const std::function<void(const Run&)>& on_change, const std::stop_token& stop = {});

 private:
  class Link;
  std::unique_ptr<Link> link_;
};

}  // namespace kcs::client
