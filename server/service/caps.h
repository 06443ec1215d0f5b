// What one kcsd takes on, at most. Every cap can be set in the configuration file, under the same name.
#pragma once

#include <cstdint>

namespace kcs::service {

// A request that passes a cap is refused with RESOURCE_EXHAUSTED, and the answer names the cap.
struct Caps {
  // Points of one tool path; for G-code its straight segments, arcs counted as their chords. 64 bytes each. A path that
  // is planned live may have any number of them; only the chords of one arc are as many at the most.
  std::uint64_t points_per_plan = 1'000'000;
  // Text of one G-code program; not of one that is planned live.
  std::uint64_t gcode_bytes = 64 << 20;
  // One message of a client. gRPC's own default, which its clients keep to as well.
  std::uint64_t message_bytes = 4 << 20;
  // Trajectories kept in memory for the streams. Beyond either number the one that was not used for longest is
  // forgotten, to be planned again from its request in the store.
  std::uint64_t cached_plans = 1'000;
  std::uint64_t cached_bytes = std::uint64_t{2} << 30;
  // Requests that wait for a planning thread, and those of one client among them. Each holds its whole tool path, and
  // what was planned of it in the turns that it had.
  std::uint64_t queue_length = 128;
  std::uint64_t client_waiting = 64;
  // Threads that plan for one client at the same time; 0: all. Clients take turns anyhow.
  std::uint64_t client_running = 0;
  // Calls of CreatePlan under way at the same time; each may hold a whole tool path, and its request as it is stored.
  std::uint64_t uploads = 128;
  std::uint64_t client_uploads = 64;  // of one client among them
  // Calls of StreamSetpoints and DescribeCorners under way at the same time; each holds a thread and one batch on its
  // way: 0.2 MB at the default batch size and three axes, 6 MB for the largest batch with all channels.
  std::uint64_t streams = 1'000;
  std::uint64_t client_streams = 1'000;  // of one client among them
  // Calls of PlanLive under way at the same time; each holds a thread, which plans, and a part of the path: some MB.
  std::uint64_t live_streams = 64;
  std::uint64_t client_live_streams = 32;  // of one client among them
  // Segments of a live path whose motion is not settled yet: the look-ahead. The planner decides by the path itself how
  // far it looks, 40,000 changes of direction at the most; a straight line may have any number of segments, 100 bytes
  // each.
  std::uint64_t look_ahead = 200'000;
  // Requests of plans over HTTP at the same time; each holds two threads beside what its call holds.
  std::uint64_t http_plans = 8;
  // Machines that are attached at the same time; each holds two threads, and the plan of its run.
  std::uint64_t machines = 100;
};

}  // namespace kcs::service
