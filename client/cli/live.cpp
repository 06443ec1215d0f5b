#include "client/cli/live.h"

#include <future>
#include <memory>
#include <ostream>
#include <stop_token>

#include "client/cli/incoming_program.h"
#include "client/cli/planner_access.h"
#include "client/cli/setpoint_writer.h"

namespace kcs::cli {
namespace {

// Sends a program to its end, or until the server or a stop ends the call; a program that cannot be read ends it too.
void send(const std::string& file, client::LiveStream& stream, std::stop_source& stop) {
  try {
    IncomingProgram program(file);
    while (true) {
      const std::string_view piece = program.next(stop.get_token());
      if (stop.stop_requested()) return;
      if (piece.empty()) return stream.end_path();
      if (!stream.send(piece)) return;
    }
  } catch (...) {
    stop.request_stop();
    throw;
  }
}

void receive(client::LiveStream& stream, SetpointWriter* writer) {
  for (client::SetpointBatch batch; stream.next(batch);) {
    if (writer != nullptr) writer->add(batch);
  }
  if (writer != nullptr) writer->finish();
}

}  // namespace

client::Plan plan_live(const Options& options, std::ostream* out) {
  const client::PlanOptions plan = plan_options(options);
  PlannerAccess access(options);
  std::stop_source stop;
  client::LiveStream stream =
      access.planner().plan_live(plan, {.period_s = options.period_s, .channels = options.channels}, stop.get_token());
  std::future<void> sent = std::async(std::launch::async, [&] { send(options.file, stream, stop); });
  try {
    std::unique_ptr<SetpointWriter> writer;
    if (out != nullptr) {
      writer = make_writer(format_of(options), {plan.machine.axes, options.channels, options.period_s}, *out);
    }
    receive(stream, writer.get());
  } catch (...) {
    stop.request_stop();
    sent.get();  // if the program cannot be read, this says so
    throw;
  }
  sent.get();
  return stream.plan();
}

}  // namespace kcs::cli
