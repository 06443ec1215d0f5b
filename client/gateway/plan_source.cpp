#include "client/gateway/plan_source.h"

#include <fmt/core.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace kcs::gateway {

PlanSource::PlanSource(std::string address, std::string name) : address_(std::move(address)), name_(std::move(name)) {}

PlanSource::PlanSource(std::string address, Program program)
    : address_(std::move(address)), program_(std::move(program)) {}

client::Plan PlanSource::obtain() {
  connect();
  client::Plan plan = program_ ? make() : planner_->get(name_);
  name_ = plan.name;
  return plan;
}

client::SetpointStream PlanSource::open(const client::StreamOptions& options) {
  return planner_->stream_setpoints(name_, options);
}

void PlanSource::reconnect() {
  connect();
  try {
    planner_->get(name_);
  } catch (const client::Error& error) {
    if (error.code() != "NOT_FOUND" || !program_) throw;
    const std::string name = make().name;
    if (name == name_) return;
    throw std::runtime_error(
        fmt::format("{} gives another plan than at the start of the run ({}, was {}): the file or "
                    "the server's version has changed; start the run again",
                    program_->file.string(), name, name_));
  }
}

void PlanSource::connect() {
  planner_.reset();  // first, for a new planner would share the old one's wait before its next attempt
  planner_.emplace(address_);
}

client::Plan PlanSource::make() {
  std::ifstream text(program_->file, std::ios::binary);
  if (!text) {
    throw std::system_error(errno, std::generic_category(), program_->file.string() + " cannot be opened for reading");
  }
  return planner_->plan_gcode(text, program_->options);
}

}  // namespace kcs::gateway
