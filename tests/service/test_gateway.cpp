#include "tests/service/test_gateway.h"

#include <algorithm>

namespace kcs::service::test {
namespace {

constexpr double kPeriod = 0.001;
constexpr std::size_t kWindow = 250;  // setpoints
constexpr std::chrono::milliseconds kStarvation{500}, kReport{20};

void fill(google::protobuf::RepeatedField<double>& numbers, const motion::Vector& vector, std::size_t axes) {
  numbers.Assign(vector.begin(), vector.begin() + axes);
}

std::uint64_t end_of(const v1::MotionBatch& batch) {
  return batch.first_tick() + static_cast<std::uint64_t>(batch.position_mm(0).values_size());
}

}  // namespace

TestMachine::TestMachine(const motion::AxisLimits& machine_limits, const motion::Vector& start)
    : limits(machine_limits), drives(machine_limits, kPeriod, start) {
  hello.set_machine("machines/mill");
  hello.set_instance("test");
  hello.set_period_s(kPeriod);
  hello.set_tail_capacity(4000);
  v1::Machine& message = *hello.mutable_limits();
  message.set_axes(static_cast<std::uint32_t>(limits.axes));
  fill(*message.mutable_velocity_mm_s(), limits.velocity, limits.axes);
  fill(*message.mutable_acceleration_mm_s2(), limits.acceleration, limits.axes);
  fill(*message.mutable_jerk_mm_s3(), limits.jerk, limits.axes);
  report.set_state(v1::MACHINE_STATE_READY);
  fill(*report.mutable_position_mm(), start, limits.axes);
  fill(*report.mutable_actual_mm(), start, limits.axes);
}

TestGateway::TestGateway(TestMachine& machine, const std::shared_ptr<grpc::Channel>& channel)
    : machine_(machine), stub_(v1::MachineService::NewStub(channel)), stream_(stub_->AttachMachine(&call_)) {
  v1::AttachMachineRequest hello;
  *hello.mutable_hello() = machine.hello;
  stream_->Write(hello);
  send_report();
  reader_ = std::thread([this] { read(); });
}

TestGateway::~TestGateway() {
  call_.TryCancel();
  reader_.join();
  if (!finished_) stream_->Finish();
}

void TestGateway::deafen() {
  const std::lock_guard lock(mutex_);
  deaf_ = true;
}

bool TestGateway::is_told_to_stop() {
  std::unique_lock lock(mutex_);
  report_until(stop_asked_, lock);
  return stop_asked_;
}

int TestGateway::signs_of_life() {
  std::unique_lock lock(mutex_);
  came_.wait_for(lock, kcs::test::kDeadline, [this] { return closed_; });
  return signs_of_life_;
}

grpc::Status TestGateway::finish() {
  std::unique_lock lock(mutex_);
  report_until(closed_, lock);
  lock.unlock();
  finished_ = closed_;
  return closed_ ? stream_->Finish() : grpc::Status(grpc::StatusCode::DEADLINE_EXCEEDED, "it goes on");
}

void TestGateway::report_until(const bool& done, std::unique_lock<std::mutex>& lock) {
  for (auto end = std::chrono::steady_clock::now() + kcs::test::kDeadline;
       !done && !closed_ && std::chrono::steady_clock::now() < end;) {
    send_report();
    came_.wait_for(lock, kReport, [&] { return done || closed_; });
  }
}

void TestGateway::read() {
  for (v1::AttachMachineResponse response; stream_->Read(&response);) {
    const std::lock_guard lock(mutex_);
    take(response);
    came_.notify_all();
  }
  const std::lock_guard lock(mutex_);
  closed_ = true;
  came_.notify_all();
}

void TestGateway::take(const v1::AttachMachineResponse& response) {
  v1::RunPosition& where = *machine_.report.mutable_run();
  if (response.has_start()) {
    where.Clear();
    where.set_run(response.start().name());
    machine_.report.clear_run_finished();
    machine_.held.clear();
  } else if (response.has_batch()) {
    const v1::MotionBatch& batch = response.batch();
    if (batch.branch() != where.branch()) return;
    while (!machine_.held.empty() && end_of(machine_.held.back()) > batch.first_tick()) machine_.held.pop_back();
    const v1::PlanClock& end = machine_.held.empty() ? where.end() : machine_.held.back().end();
    EXPECT_EQ(batch.first_tick(), machine_.held.empty() ? where.ticks_played() : end_of(machine_.held.back()));
    EXPECT_EQ(batch.begin().SerializeAsString(), end.SerializeAsString());
    machine_.held.push_back(batch);
  } else if (response.has_command()) {
    stop_asked_ = !deaf_;
  } else if (response.content_case() == v1::AttachMachineResponse::CONTENT_NOT_SET) {
    ++signs_of_life_;
  }
}

void TestGateway::send_report() {
  update_position();
  v1::AttachMachineRequest message;
  *message.mutable_report() = machine_.report;
  stream_->Write(message);
}

void TestGateway::update_position() {
  if (!machine_.report.has_run()) return;
  v1::RunPosition& where = *machine_.report.mutable_run();
  where.clear_batch_ends();
  const auto add = [&where](std::uint64_t tick, const v1::PlanClock& clock) {
    v1::BatchEnd& end = *where.add_batch_ends();
    end.set_tick(tick);
    *end.mutable_clock() = clock;
  };
  add(where.ticks_played(), where.end());
  for (const v1::MotionBatch& batch : machine_.held) add(end_of(batch), batch.end());
  v1::RunPosition reported = where;
  where.set_ticks_committed(where.ticks_played());
  where.set_ticks_held(where.batch_ends(where.batch_ends_size() - 1).tick());
}

bool TestGateway::play() {
  std::unique_lock lock(mutex_);
  v1::RunPosition& where = *machine_.report.mutable_run();
  const bool rests = machine_.report.state() != v1::MACHINE_STATE_RUNNING;
  const auto has_enough = [this] {
    return stop_asked_ || closed_ ||
           (!machine_.held.empty() && (machine_.held.back().end_of_plan() ||
                                       end_of(machine_.held.back()) >= machine_.report.run().ticks_played() + kWindow));
  };
  came_.wait_for(lock, rests ? std::chrono::milliseconds(kcs::test::kDeadline) : kStarvation, has_enough);
  if (machine_.held.empty() || stop_asked_) {
    stop();
    send_report();
    return false;
  }
  machine_.playing = machine_.held.front();
  machine_.held.pop_front();
  play(machine_.playing.position_mm());
  *where.mutable_end() = machine_.playing.end();
  machine_.report.set_state(v1::MACHINE_STATE_RUNNING);
  const bool ended = machine_.playing.end_of_plan();
  if (ended) machine_.report.set_state(v1::MACHINE_STATE_READY);
  machine_.report.set_run_finished(ended);
  send_report();
  return !ended && !testing::Test::HasFatalFailure();
}

void TestGateway::play(const google::protobuf::RepeatedPtrField<v1::Column>& columns) {
  const int count = columns.empty() ? 0 : columns[0].values_size();
  for (int i = 0; i < count; ++i) {
    motion::Vector position = motion::Vector::Zero();
    for (int axis = 0; axis < columns.size(); ++axis) position[axis] = columns[axis].values(i);
    machine_.drives.take(position);
    machine_.played.push_back(position);
  }
  v1::RunPosition& where = *machine_.report.mutable_run();
  const std::uint64_t first = where.ticks_played(), end = first + static_cast<std::uint64_t>(count);
  for (const v1::MarkerAt& marker : machine_.playing.markers()) {
    if (marker.tick() >= first && marker.tick() < end) machine_.switched.push_back(marker);
  }
  where.set_ticks_played(end);
  fill(*machine_.report.mutable_position_mm(), machine_.drives.position(), machine_.limits.axes);
  fill(*machine_.report.mutable_actual_mm(), machine_.drives.position(), machine_.limits.axes);
}

void TestGateway::stop() {
  stop_asked_ = false;
  machine_.held.clear();
  if (machine_.report.state() != v1::MACHINE_STATE_RUNNING) return;
  play(machine_.playing.tail_mm());
  machine_.drives.rest();
  v1::RunPosition& where = *machine_.report.mutable_run();
  where.mutable_end()->Clear();
  where.mutable_end()->set_plan_time_s(machine_.playing.tail_end_s());
  where.set_branch(where.branch() + 1);
  machine_.report.set_state(v1::MACHINE_STATE_HELD);
}

}  // namespace kcs::service::test
