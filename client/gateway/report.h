// What a run amounted to, for people and for programs.
#pragma once

#include <string>

#include "client/gateway/playback.h"

namespace kcs::gateway {

// A table.
std::string report_table(const client::Plan& plan, const PlaybackOptions& options, const PlaybackResult& result);

// One JSON object. Lengths in mm, times in s, lateness in µs, as the keys say.
std::string report_json(const client::Plan& plan, const PlaybackOptions& options, const PlaybackResult& result);

}  // namespace kcs::gateway
