#include "tests/unit/gateway/machine/straight_server.h"

#include <algorithm>

namespace kcs::gateway {

v1::AttachMachineResponse StraightServer::start() const {
  v1::AttachMachineResponse order;
  order.mutable_start()->set_name(run_);
  order.mutable_start()->set_plan("plans/straight");
  for (int axis = 0; axis < axes_; ++axis) order.mutable_start()->add_position_mm(0);
  return order;
}

v1::AttachMachineResponse StraightServer::resume_order() const {
  v1::AttachMachineResponse order;
  order.mutable_resume()->set_run(run_);
  order.mutable_resume()->set_branch(*branch_);
  return order;
}

v1::AttachMachineResponse StraightServer::hold() {
  holding_ = true;
  branch_.reset();
  v1::AttachMachineResponse order;
  order.set_command(v1::MACHINE_COMMAND_HOLD);
  return order;
}

std::vector<v1::AttachMachineResponse> StraightServer::react(const v1::MachineReport& report) {
  if (!report.has_run()) {
    if (report.state() != v1::MACHINE_STATE_READY) return {};
    return {start()};
  }
  const v1::RunPosition& position = report.run();
  finished_ = report.run_finished();
  if (finished_ || holding_) return {};
  std::vector<v1::AttachMachineResponse> orders;
  const bool goes_on = branch_ == position.branch();
  const bool rests = report.state() == v1::MACHINE_STATE_HELD || report.state() == v1::MACHINE_STATE_READY;
  if (!goes_on) {
    if (!rests) return {};
    branch_ = position.branch();
    begins_ = position.ticks_committed();
    sent_ = begins_;
    const v1::PlanClock& clock = position.batch_ends(0).clock();
    motion_.emplace(clock.plan_time_s(), length_, period_, axes_);
    orders.push_back(resume_order());
  } else if (rewinds_ || report.counters().refused_batches() != refused_) {
    sent_ = position.ticks_held();
    orders.push_back(resume_order());
  }
  rewinds_ = false;
  refused_ = report.counters().refused_batches();
  while (sent_ - begins_ < motion_->size() &&
         static_cast<double>(sent_) - static_cast<double>(position.ticks_played()) < window_ / period_) {
    const std::uint64_t first = sent_ - begins_;
    *orders.emplace_back().mutable_batch() = motion_->batch(run_, *branch_, sent_, first, kBatch);
    sent_ += std::min(kBatch, motion_->size() - first);
  }
  return orders;
}

}  // namespace kcs::gateway
