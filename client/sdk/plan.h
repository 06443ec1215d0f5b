// What is asked of a plan, and what comes back. proto/kcs/v1/planning.proto says every field in full.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/sdk/machine.h"

namespace kcs::client {

// What a tolerance limits at a corner.
enum class ToleranceKind {
  kContourError,    // the largest distance from the smoothed curve to the programmed path
  kCornerDistance,  // the distance from the corner point to the middle of the smoothed corner
};

// How corners are taken.
enum class CornerStrategy {
  kAuto,           // the fastest, for each corner
  kInterrupted,    // no acceleration where the corner begins and ends
  kUninterrupted,  // brakes into the corner, accelerates out of it
  kExactStop,      // stops on the corner point
  kBlended,        // between kInterrupted and kUninterrupted
  kOverlapping,    // passed within one smooth motion through many corners; only reported, cannot be asked for
};

// Who goes first where requests of one client wait for each other.
enum class Priority {
  kBatch,  // when nothing else of this client waits
  kNormal,
  kInteractive,  // before everything else of this client: somebody looks at a screen
};

struct PlanOptions {
  Machine machine;
  std::optional<double> tolerance_mm;  // none: the server's default, 0.01 mm
  ToleranceKind tolerance_kind = ToleranceKind::kContourError;
  CornerStrategy strategy = CornerStrategy::kAuto;
  std::optional<double> feed_mm_s;  // replaces every programmed feed and the rapid; none: as programmed
  std::vector<double> start_mm;     // where a G-code program starts, one per axis; empty: the machine's zero
  // How the tool moves at the start of the path, along its first segment, and at its end, along its last: at rest
  // unless it goes on from one motion to another.
  double start_speed_mm_s = 0;
  double start_acceleration_mm_s2 = 0;
  double end_speed_mm_s = 0;
  // No part of the plan: how it is made. What a server gives back as the options of a plan leaves them out.
  Priority priority = Priority::kNormal;
  // The server answers as soon as the request is safely kept, and plans it even if this client goes away; the plan that
  // comes back has no summary yet unless it was made before. Planner::await() waits for it.
  bool accept_only = false;
};

// The tool stops on a point of a path.
struct Stop {
  std::size_t point = 0;  // index of the point, from 0
  double dwell_s = 0;     // how long it stays
};

// A tool path of straight segments, given by its points. The arrays `feed_mm_s` and `tolerance_mm` have one entry per
// point (for the segment that ends there), or a single one for the whole path, or none for what the options say.
struct PointPath {
  std::vector<double> points_mm;  // x0, y0, z0, x1, y1, z1, …: one number per axis
  std::vector<double> feed_mm_s;
  std::vector<double> tolerance_mm;
  std::vector<std::uint32_t> line;  // of the program, from 1: one per point, or none
  std::vector<Stop> stops;          // in the order of the points
};

// What a plan amounts to. The max_* figures are found by the server's verifier, exactly, not by sampling.
struct Summary {
  double cycle_time_s = 0;
  double path_length_mm = 0;
  std::uint64_t segment_count = 0;
  std::uint64_t corner_count = 0;
  std::uint64_t interrupted_count = 0;  // corners by strategy
  std::uint64_t uninterrupted_count = 0;
  std::uint64_t exact_stop_count = 0;
  std::uint64_t blended_count = 0;
  std::uint64_t overlapping_count = 0;
  double time_lost_at_corners_s = 0;
  double dwell_time_s = 0;
  double time_at_feed_s = 0;
  double max_contour_error_mm = 0;
  double max_chord_error_mm = 0;
  double max_feed_mm_s = 0;
  std::vector<double> max_velocity_mm_s;  // one per axis, as are the next two
  std::vector<double> max_acceleration_mm_s2;
  std::vector<double> max_jerk_mm_s3;
  std::uint64_t phase_count = 0;
  std::uint64_t marker_count = 0;  // what is switched along the path; a dwell counts as two
  std::vector<double> start_mm;    // first and last point, one number per axis
  std::vector<double> end_mm;
};

// Something about the program that its author should know.
struct Notice {
  std::uint32_t line = 0;   // where it came up first, from 1
  std::string text;         // what was noticed, and what kcs did about it
  std::uint64_t count = 0;  // how often it came up
};

// What has become of a request.
enum class PlanState {
  kWaiting,   // for its turn
  kPlanning,  // is being planned
  kReady,     // is there, with its summary
  kRefused,   // after it was accepted without waiting for it: Planner::get() says why
};

using Time = std::chrono::sys_time<std::chrono::microseconds>;

// A plan that a server keeps. Of one that is not kReady: name, state and time alone.
struct Plan {
  std::string name;     // "plans/…": asks for its setpoints and corners
  PlanOptions options;  // as they were used, defaults filled in
  Summary summary;
  std::vector<Notice> notices;
  PlanState state = PlanState::kReady;
  Time create_time{};  // when the server accepted the request for the first time; of a live plan none
};

// One joint of the path at which the direction changes or the tool stops. Of a kOverlapping one: where the tool is
// nearest to it.
struct Corner {
  std::uint64_t segment = 0;                             // that ends here, from 0
  std::uint32_t line = 0;                                // of the program; 0 if not known
  double angle_deg = 0;                                  // direction change, 0 (straight on) to 180 (reversal)
  CornerStrategy strategy = CornerStrategy::kExactStop;  // never kAuto
  double speed_mm_s = 0;                                 // where the corner begins and ends
  double boundary_acceleration_mm_s2 = 0;                // magnitude, there, along the path
  double duration_s = 0;                                 // inside the corner, dwell included
  double deviation_mm = 0;                               // comparable with the tolerance
  double time_lost_s = 0;                                // cycle time that the corner costs
  std::vector<double> point_mm;                          // one number per axis
  double corner_distance_mm = 0;
  double contour_error_mm = 0;
  double dwell_s = 0;
};

}  // namespace kcs::client
