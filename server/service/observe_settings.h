// What a server shows of itself, and where.
#pragma once

#include <string>

#include "server/observe/log.h"
#include "server/service/settings_file.h"

namespace kcs::service {

struct ObserveSettings {
  // Where /metrics, /healthz and /readyz are asked for, "HOST:PORT"; empty: nowhere.
  std::string http_listen;
  // Serves gRPC's channelz, once a server of the process does: who is connected, and how much went to and fro.
  bool channelz = false;
  observe::LogFormat log_format = observe::LogFormat::kText;
};

// The keys of [observe]. Keeps a reference to `settings`.
Keys observe_keys(ObserveSettings& settings);

// Throws std::runtime_error that names the formats.
observe::LogFormat parse_log_format(const std::string& name);

}  // namespace kcs::service
