#include "client/gateway/machine/staging.h"

#include <fmt/format.h>
#include <google/protobuf/util/message_differencer.h>

#include <algorithm>

#include "client/gateway/machine/batch_check.h"

namespace kcs::gateway {
namespace {

std::uint32_t rows(const google::protobuf::RepeatedPtrField<v1::Column>& columns) {
  return columns.empty() ? 0 : static_cast<std::uint32_t>(columns[0].values_size());
}

v1::BatchEnd batch_end(std::uint64_t tick, const v1::PlanClock& clock) {
  v1::BatchEnd end;
  end.set_tick(tick);
  *end.mutable_clock() = clock;
  return end;
}

v1::BatchEnd rest_at(std::uint64_t tick, double plan_time_s) {
  v1::PlanClock clock;
  clock.set_plan_time_s(plan_time_s);
  return batch_end(tick, clock);
}

bool rests(const kcs_player_report& report) {
  return report.state != KCS_PLAYER_RUNNING && report.state != KCS_PLAYER_STOPPING;
}

void fill_rows(const google::protobuf::RepeatedPtrField<v1::Column>& columns, std::uint32_t first,
               kcs_player_batch& slot) {
  for (int axis = 0; axis < columns.size(); ++axis) {
    for (std::uint32_t row = 0; row < rows(columns); ++row) {
      slot.position_mm[first + row][axis] = columns[axis].values(static_cast<int>(row));
    }
  }
}

// A slot may hold an older batch: everything that the player reads is written, also of an axis that is not there.
void fill(const v1::MotionBatch& motion, std::uint64_t run, kcs_player_batch& slot) {
  slot.run = run;
  slot.branch = motion.branch();
  slot.first_tick = motion.first_tick();
  slot.setpoints = rows(motion.position_mm());
  slot.tail = rows(motion.tail_mm());
  slot.last = motion.end_of_plan() ? 1 : 0;
  slot.rest_s = slot.tail == 0 ? motion.end().plan_time_s() : motion.tail_end_s();
  slot.marker_count = static_cast<std::uint32_t>(motion.markers_size());
  for (int i = 0; i < motion.markers_size(); ++i) {
    const v1::MarkerAt& marker = motion.markers(i);
    // One that was due earlier comes with the first setpoint: what is switched stays switched.
    const std::uint64_t due = std::max(marker.tick(), motion.first_tick()) - motion.first_tick();
    slot.markers[i] = {static_cast<std::uint32_t>(due), static_cast<std::uint32_t>(marker.marker().kind()),
                       marker.marker().value()};
  }
  for (std::uint32_t row = 0; row < slot.setpoints + slot.tail; ++row) {
    std::fill(std::begin(slot.position_mm[row]), std::end(slot.position_mm[row]), 0.0);
  }
  fill_rows(motion.position_mm(), 0, slot);
  fill_rows(motion.tail_mm(), slot.setpoints, slot);
}

}  // namespace

Staging::Staging(std::size_t axes, double period_s, double commit_s)
    : axes_(axes), period_(period_s), commit_time_(commit_s) {}

void Staging::begin(std::uint64_t number, double plan_time_s) {
  run_ = number;
  branch_ = 0;
  played_ = 0;
  left_ = false;
  at_rest_ = true;
  stand_at(rest_at(0, plan_time_s));
}

void Staging::adopt(const kcs_player_report& report) {
  run_ = report.run;
  branch_ = report.branch;
  left_ = true;
  refused_ = report.refused;
  stand_at(rest_at(report.played, report.rest_s));
  follow(report);
}

void Staging::stand_at(const v1::BatchEnd& rest) {
  origin_ = rest;
  committed_ = rest;
  flowing_ = false;
  staged_.clear();
}

StagingResult Staging::stage(const v1::MotionBatch& batch) {
  if (batch.branch() < branch_) return {Staged::kStale, ""};
  if (batch.branch() > branch_) {
    return {Staged::kRefused, fmt::format("it is for branch {}, the machine is at {}", batch.branch(), branch_)};
  }
  if (auto damage = find_damage(batch, axes_)) return {Staged::kRefused, std::move(*damage)};
  if (left_ && !at_rest_) return {Staged::kRefused, "the machine has not come to rest yet"};
  if (auto gap = find_gap(batch)) return {Staged::kRefused, std::move(*gap)};
  if (is_held_already(batch)) return {};
  while (!staged_.empty() && staged_.back().motion.first_tick() >= batch.first_tick()) staged_.pop_back();
  if (staged_.size() == kMostBatches) return {Staged::kRefused, "too much motion is held already"};
  staged_.push_back({batch, batch_end(batch.first_tick() + rows(batch.position_mm()), batch.end())});
  return {};
}

std::optional<std::string> Staging::find_gap(const v1::MotionBatch& batch) const {
  const std::uint64_t first = batch.first_tick();
  if (first < committed_.tick()) {
    return fmt::format("it begins at tick {}, too late: up to {} the player has its setpoints", first,
                       committed_.tick());
  }
  if (first > held().tick()) {
    return fmt::format("it begins at tick {}, but the motion held ends at {}", first, held().tick());
  }
  const auto staged =
      std::find_if(staged_.begin(), staged_.end(), [&](const Batch& b) { return b.end.tick() == first; });
  if (first != committed_.tick() && staged == staged_.end()) {
    return fmt::format("it begins at tick {}, which is no batch's end", first);
  }
  const v1::PlanClock& clock = first == committed_.tick() ? committed_.clock() : staged->end.clock();
  if (batch.has_begin() && !google::protobuf::util::MessageDifferencer::Equals(batch.begin(), clock)) {
    return fmt::format("it goes on from another place or pace than the machine's at tick {}", first);
  }
  return std::nullopt;
}

bool Staging::is_held_already(const v1::MotionBatch& batch) const {
  return std::any_of(staged_.begin(), staged_.end(), [&](const Batch& held) {
    return held.motion.first_tick() == batch.first_tick() &&
           held.motion.SerializeAsString() == batch.SerializeAsString();
  });
}

bool Staging::follow(const kcs_player_report& report) {
  at_rest_ = rests(report);
  const bool refused = report.refused != refused_;
  refused_ = report.refused;
  const bool begun = report.run == run_;
  const bool leaves = begun && report.branch != branch_;
  if (begun) {
    played_ = report.played;
    branch_ = report.branch;
    left_ = left_ || leaves;
  }
  const bool on_tail = left_ && report.played != origin_.tick();
  if (leaves || on_tail) stand_at(rest_at(report.played, report.rest_s));
  // A player that refuses to begin stays on its branch.
  const bool does_not_begin = flowing_ && at_rest_ && refused;
  if (does_not_begin) stand_at(origin_);
  return leaves || does_not_begin;
}

bool Staging::may_begin() const {
  if (flowing_ || staged_.empty()) return flowing_;
  // In a dwell it rests as well, yet goes on.
  const bool stays = rows(staged_.back().motion.tail_mm()) == 0 && held().clock().rate() == 0;
  return stays || static_cast<double>(held().tick() - committed_.tick()) * period_ >= commit_time_;
}

void Staging::commit(kcs_player_memory& player) {
  if (!may_begin()) return;
  while (!staged_.empty() && static_cast<double>(committed_.tick() - played_) * period_ < commit_time_) {
    kcs_player_batch* slot = kcs_player_free_slot(&player);
    if (slot == nullptr) return;
    fill(staged_.front().motion, run_, *slot);
    kcs_player_put(&player);
    committed_ = staged_.front().end;
    staged_.pop_front();
    flowing_ = true;
    left_ = false;
  }
}

v1::RunPosition Staging::position() const {
  v1::RunPosition position;
  position.set_branch(branch_);
  position.set_ticks_played(played_);
  position.set_ticks_committed(committed_.tick());
  position.set_ticks_held(held().tick());
  *position.mutable_end() = held().clock();
  *position.add_batch_ends() = committed_;
  for (const Batch& batch : staged_) *position.add_batch_ends() = batch.end;
  return position;
}

}  // namespace kcs::gateway
