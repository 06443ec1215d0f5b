// A part of a path, planned up to its end as if nothing came after it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "server/planning/corner_log.h"
#include "server/planning/corner_plan.h"
#include "server/planning/entry.h"
#include "server/planning/motion_builder.h"

namespace kcs::planning {

class Section {
 public:
  // A place in the motion where another plan may take over.
  struct Cut {
    std::size_t stage = 0;
    std::size_t pieces = 0;  // of this stage's stretch that come before it; 0: it lies before the stage

    bool operator==(const Cut&) const = default;
  };

  // The motion from `entry` to the end of the path, there at end_speed (mm/s) or slower. Nothing, if there is none.
  // alone: nothing comes before or after it.
  static std::unique_ptr<Section> plan(LegPath path, Entry entry, double end_speed, bool alone,
                                       const PlanOptions& options);

  const LegPath& path() const { return path_; }
  // A stretch of it is taken corner by corner because no smooth motion was found.
  bool taken_apart() const { return corners_.taken_apart; }
  double end_speed() const { return corners_.speeds.back(); }  // mm/s

  // Makes stretches faster up to a cut; not what comes after it, which is planned again.
  void tighten(const Cut& to);
  // Makes the phases, from `time` (s) on.
  void build(double time);
  // From one place to another. Phases name segments of the whole path.
  std::span<const motion::Phase> phases(const Cut& from, const Cut& to) const;
  // Records the corners from one place to another; returns the time at the feed, s.
  double record(const Cut& from, const Cut& to, CornerLog& log) const;

  Cut begin() const { return {}; }
  Cut end() const { return {corners_.stages.size(), 0}; }
  // The last place that does not lie after a leg, or the first one at all.
  Cut cut_at(std::size_t leg) const;
  // A place some way after `cut`; end() at last.
  Cut cut_after(const Cut& cut) const;

  // What a plan must go on with that takes over at a cut: from which leg on, and how.
  struct Rest {
    std::size_t first_leg;
    Entry entry;
  };
  Rest rest_from(const Cut& cut) const;

 private:
  Section(LegPath path, Entry entry, const PlanOptions& options)
      : path_(std::move(path)), entry_(std::move(entry)), options_(options) {}

  CornerGeometry geometry(std::size_t joint) const {
    return corner_geometry(path_.legs[joint], path_.legs[joint + 1], options_);
  }
  CornerMotion motion_after(std::size_t stage) const { return corners_.stages[stage].exit.at(corners_.speeds[stage]); }
  // Another plan can take over between this stage and the next.
  bool ends_well(const Stage& stage) const { return stage.ends_on_joint || stage.stretch; }
  std::optional<Cut> cut_inside(std::size_t stage, std::size_t leg) const;
  std::size_t phase_at(const Cut& cut) const;
  Rest rest_of_stretch(const Cut& cut) const;
  void build_joint(MotionBuilder& builder, std::size_t stage) const;
  double record_stretch(std::size_t stage, std::size_t from, std::size_t to, CornerLog& log) const;
  void record_joint(std::size_t stage, double exit_lost, CornerLog& log) const;

  LegPath path_;
  Entry entry_;
  PlanOptions options_;
  CornerPlan corners_;
  std::vector<motion::Phase> phases_;
  std::vector<std::size_t> first_phases_;  // of each stage
  std::vector<LegTimes> leg_times_;        // of each stage
};

}  // namespace kcs::planning
