// What is planned, and what is kept of it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/gcode/notices.h"
#include "server/planning/options.h"
#include "server/planning/plan.h"
#include "server/planning/toolpath.h"

namespace kcs::jobs {

// The options of a request, defaults filled in.
struct RequestOptions {
  std::string machine_name;
  planning::PlanOptions planning;
  std::optional<double> rapid;            // mm/s; none: as fast as the axes' limits allow
  double tolerance = 0.01;                // mm, where the path says nothing else
  std::optional<double> feed;             // mm/s, instead of every programmed feed and the rapid
  std::optional<planning::Vector> start;  // mm, of a G-code program; a path of points has none
  // How the tool moves where the path starts and ends, along it, see planning::PathEnds.
  double start_speed = 0;         // mm/s
  double start_acceleration = 0;  // mm/s²
  double end_speed = 0;           // mm/s

  // The ends of a path that starts at `from`, mm.
  planning::PathEnds ends(const planning::Vector& from) const {
    return {
        .start = from, .start_speed = start_speed, .start_acceleration = start_acceleration, .end_speed = end_speed};
  }
};

// What a request says, beside the path.
struct RequestRecord {
  std::string name;  // from RequestDigest: requests of the same name are the same
  RequestOptions options;
  std::vector<gcode::Notice> notices;
  double max_chord_error = 0;  // mm, between the arcs of the program and their chords
};

// A request, decoded and checked.
struct PlanRequest : RequestRecord {
  std::string call;  // id of the call that brought it, for the log
  planning::Toolpath path;
};

// A plan as the server keeps it. It never changes; whoever holds the pointer may go on reading after it is forgotten.
struct KeptPlan : RequestRecord {
  planning::Plan plan;
};
using PlanPointer = std::shared_ptr<const KeptPlan>;

}  // namespace kcs::jobs
