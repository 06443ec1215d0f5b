// A stretch of the path whose corners are too near to each other to be taken one by one: one smooth motion through all
// of them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "server/planning/entry.h"
#include "server/planning/options.h"
#include "server/planning/smooth_motion.h"
#include "server/planning/stretch_path.h"

namespace kcs::planning {

class Stretch {
 public:
  // `path` and `begun` must outlive the stretch. Its legs have tolerances of more than 0. at_most: the speeds
  // at its ends, 0 for rest. begun: what is settled of it, or null.
  Stretch(const LegPath& path, const LegRange& range, const PlanOptions& options, const EndSpeeds& at_most,
          const BegunStretch* begun = nullptr);

  // No motion that keeps everything was found: the stretch has to be travelled in another way.
  bool failed() const { return !found_; }

  // A motion whose speeds at the ends are at most these, mm/s; the speeds that it has. If it fails, they are 0.
  EndSpeeds plan(const EndSpeeds& at_most);

  // Makes the motion faster up to the end of a piece, where its speed and its acceleration stay, if the effort asks for
  // that; once. `pieces`: how many come before there. plan() is of no more use then.
  void tighten(std::size_t pieces);

  const StretchPath& path() const { return path_; }
  // Those that were settled before, and those that were found.
  std::span<const StretchPiece> pieces() const { return pieces_; }
  double duration() const { return pieces_.back().phase.end_time(); }  // of all of them, s
  EndSpeeds speeds() const { return found_ ? found_->speeds : EndSpeeds{}; }
  // The first piece that was not settled before.
  std::size_t first_piece() const { return begun_ == nullptr ? 0 : begun_->settled.size(); }
  // A piece where it is on the machine, with the segments of the whole path.
  motion::Phase phase(std::size_t piece) const;

  // The stretch from its first so many pieces on, more than first_piece(), for a part of the path that begins with its
  // leg `leg`.
  BegunStretch go_on(std::size_t pieces, std::size_t leg) const;

 private:
  struct Found {
    TimeSpline spline;  // from the last three settled points on, as it was before it was tightened
    FitWeights weights;
    EndSpeeds speeds;
  };

  MotionRange motion_range(const EndSpeeds& at_most, bool exact) const;
  std::optional<Found> search(const MotionRange& range, MotionDraft draft) const;
  std::optional<Found> search_slower(const EndSpeeds& at_most) const;
  void take(std::optional<Found> found);
  MotionDraft draft(const MotionRange& range) const;

  AxisLimits limits_;
  Effort effort_;
  std::stop_token stop_;
  const BegunStretch* begun_;
  StretchPath path_;
  double step_;  // of what is searched, s
  bool dense_ = false, long_steps_ = false;
  TimeSpline last_;  // the last three settled points, if there are any
  std::vector<StretchPiece> pieces_;
  std::optional<Found> found_;
  bool slowed_ = false;  // once already
  bool tightened_ = false;
};

}  // namespace kcs::planning
