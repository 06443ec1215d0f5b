// Watches a run from beside it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <thread>

#include "client/gateway/measurement.h"
#include "client/gateway/recording.h"
#include "client/gateway/trace.h"

namespace kcs::gateway {

struct ObserverOptions {
  std::size_t axes = 3;                                  // 2 or 3
  double period_s = 0.001;                               // of the ticks
  std::optional<std::filesystem::path> record;           // where to write every tick; none: nowhere
  std::function<void(std::uint64_t ticks)> on_progress;  // called now and then; empty: nobody wants to know
};

// Takes ticks off a trace, measures them and records them if asked to, on a thread of its own: the thread that plays
// only has to put them there.
class Observer {
 public:
  // Throws std::system_error if the recording cannot be written.
  explicit Observer(ObserverOptions options);

  // Where the playing thread puts its ticks.
  Trace& trace() { return trace_; }

  // Measures what is left on the trace. Call once, when nothing more comes. Throws std::system_error if the recording
  // could not be written.
  RunFigures finish();

 private:
  void run(const std::stop_token& stop);

  ObserverOptions options_;
  Trace trace_;
  Measurement measurement_;
  std::optional<Recording> recording_;
  std::jthread thread_;  // last: it uses all the others
};

}  // namespace kcs::gateway
