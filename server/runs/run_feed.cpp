#include "server/runs/run_feed.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace kcs::runs {

void RunFeed::go_on_from(const MachinePosition& position) {
  // A replacement that came too late, so that the machine did not take it, is made again with more time.
  if (position.branch != branch_) replacing_from_.reset();
  replace_ = replacing_from_.has_value();
  margin_ = std::min(2 * margin_, options_.window);
  branch_ = position.branch;
  sent_.assign(position.ends.begin(), position.ends.end());
  ended_ = false;
  update(position);
}

void RunFeed::update(const MachinePosition& position) {
  if (position.branch != branch_) pause();
  if (sent_.empty()) {
    plan_time_ = position.ends.front().clock.plan_time;
    return;
  }
  played_ = position.played;
  committed_ = position.committed;
  if (replacing_from_ && committed_ > *replacing_from_ + options_.window) replacing_from_.reset();
  while (sent_.size() > 1 && sent_[1].tick <= played_) sent_.pop_front();
  const BatchEnd& before = sent_.front();
  plan_time_ = before.clock.plan_time;
  if (sent_.size() == 1 || played_ <= before.tick) return;
  const double share = static_cast<double>(played_ - before.tick) / static_cast<double>(sent_[1].tick - before.tick);
  plan_time_ += share * (sent_[1].clock.plan_time - before.clock.plan_time);
}

void RunFeed::set_rate(double rate) {
  if (rate == rate_) return;
  replace_ = true;
  margin_ = options_.margin;
  rate_ = rate;
}

std::optional<NumberedBatch> RunFeed::next() {
  if (sent_.empty()) return {};
  if (std::exchange(replace_, false)) replace_from(committed_ + margin_);
  const BatchEnd begin = sent_.back();
  if (ended_ || begin.tick >= played_ + options_.window) return {};
  auto made = batches_.next(begin.clock, rate_);
  if (!made) throw std::runtime_error("no way on is found that can be stopped; the run stops on its path");
  ended_ = made->end_of_plan;
  sent_.push_back({begin.tick + made->positions.size(), made->end});
  return NumberedBatch{.branch = branch_, .begin = begin, .batch = *std::move(made)};
}

// Batches that begin there or later are made again. Those of the window are soon played in any case.
void RunFeed::replace_from(std::uint64_t tick) {
  const auto kept = std::find_if(sent_.begin(), sent_.end(), [tick](const BatchEnd& end) { return end.tick >= tick; });
  if (kept == sent_.end() || kept + 1 == sent_.end()) return;
  replacing_from_ = kept->tick;
  sent_.erase(kept + 1, sent_.end());
  ended_ = false;
}

}  // namespace kcs::runs
