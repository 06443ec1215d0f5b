#include "client/gateway/plan_source.h"

#include <fmt/core.h>

#include <utility>

#include "client/common/file_error.h"
#include "client/common/program_file.h"
#include "client/sdk/error.h"

namespace kcs::gateway {
namespace {

// Drives cannot be thrown into a motion, nor out of one.
void require_rest(const client::Plan& plan) {
  const client::PlanOptions& options = plan.options;
  if (options.start_speed_mm_s == 0 && options.start_acceleration_mm_s2 == 0 && options.end_speed_mm_s == 0) return;
  throw client::Error(
      "FAILED_PRECONDITION",
      fmt::format("{} begins or ends in motion, and drives start and stop at rest: plan the path without "
                  "speeds at its ends",
                  plan.name));
}

// Who plays cannot wait for the library's pauses: the feed tries again by itself, and counts it.
client::Connection in_own_time(client::Connection server) {
  server.tries_again = false;
  return server;
}

}  // namespace

PlanSource::PlanSource(client::Connection server, std::string name)
    : server_(in_own_time(std::move(server))), name_(std::move(name)) {}

PlanSource::PlanSource(client::Connection server, Program program)
    : server_(in_own_time(std::move(server))), program_(std::move(program)) {}

client::Plan PlanSource::obtain() {
  connect();
  client::Plan plan = program_ ? make({}) : planner_->get(name_);
  require_rest(plan);
  name_ = plan.name;
  return plan;
}

client::SetpointStream PlanSource::open(const client::StreamOptions& options, const std::stop_token& stop) {
  return planner_->stream_setpoints(name_, options, stop);
}

void PlanSource::reconnect(const std::stop_token& stop) {
  connect();
  try {
    planner_->get(name_, stop);
  } catch (const client::Error& error) {
    if (error.code() != "NOT_FOUND" || !program_) throw;
    const std::string name = make(stop).name;
    if (name == name_) return;
    throw client::FileError(
        fmt::format("{} gives another plan than at the start of the run ({}, was {}): the file or "
                    "the server's version has changed; start the run again",
                    program_->file.string(), name, name_));
  }
}

void PlanSource::connect() {
  planner_.reset();  // first, for a new planner would share the old one's wait before its next attempt
  planner_.emplace(server_);
}

client::Plan PlanSource::make(const std::stop_token& stop) {
  std::ifstream program = client::open_program(program_->file);
  return planner_->plan_gcode(program, program_->options, stop);
}

}  // namespace kcs::gateway
