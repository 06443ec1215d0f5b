// Where the gateway's plan comes from.
#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

#include "client/sdk/planner.h"

namespace kcs::gateway {

// A G-code program to have planned, and how.
struct Program {
  std::filesystem::path file;
  client::PlanOptions options;
};

// A plan on a server: one that the server keeps, or one that is made from a program. A server that was restarted may
// have forgotten it; then it is made again, and since the same request gives the same plan, setpoints go on where they
// were. Calls throw client::Error; client::FileError if the program's file cannot be read or has changed meanwhile.
class PlanSource {
 public:
  // The plan `name` ("plans/…") that the server keeps.
  PlanSource(client::Connection server, std::string name);

  // The plan that the server makes of `program`.
  PlanSource(client::Connection server, Program program);

  // Fetches the plan, or has it made.
  client::Plan obtain();

  // Opens a stream of the plan that obtain() gave. It breaks off when a stop is requested.
  client::SetpointStream open(const client::StreamOptions& options, const std::stop_token& stop);

  // After a failure: connects anew, so that a server that is back is found at once, and sees to it that the server has
  // the plan. Ends at once when a stop is requested.
  void reconnect(const std::stop_token& stop);

 private:
  void connect();
  client::Plan make(const std::stop_token& stop);

  client::Connection server_;
  std::string name_;
  std::optional<Program> program_;
  std::optional<client::Planner> planner_;
};

}  // namespace kcs::gateway
