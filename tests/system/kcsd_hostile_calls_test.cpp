// Calls with the worst numbers and counts, calls that do not go on, and calls that are given up.
#include <google/protobuf/message.h>
#include <signal.h>

#include <deque>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/system/hostile_clients.h"

namespace kcs::test {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Calls spoil(set, field) for every number of this kind in a message; set(value) puts another one in its place.
template <typename Spoil>
void for_each_double(Message& message, const Spoil& spoil) {
  const auto& reflection = *message.GetReflection();
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor& field = *message.GetDescriptor()->field(i);
    const bool is_message = field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
    if (is_message && field.is_repeated()) {
      for (int k = 0; k < reflection.FieldSize(message, &field); ++k) {
        for_each_double(*reflection.MutableRepeatedMessage(&message, &field, k), spoil);
      }
    } else if (is_message && reflection.HasField(message, &field)) {
      for_each_double(*reflection.MutableMessage(&message, &field), spoil);
    }
    if (field.cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE) continue;
    if (!field.is_repeated()) {
      const bool was_unset = field.has_presence() && !reflection.HasField(message, &field);
      const double before = reflection.GetDouble(message, &field);
      spoil([&](double value) { reflection.SetDouble(&message, &field, value); }, field.full_name());
      reflection.SetDouble(&message, &field, before);
      if (was_unset) reflection.ClearField(&message, &field);
      continue;
    }
    for (int k = 0; k < reflection.FieldSize(message, &field); ++k) {
      const double before = reflection.GetRepeatedDouble(message, &field, k);
      spoil([&](double value) { reflection.SetRepeatedDouble(&message, &field, k, value); }, field.full_name());
      reflection.SetRepeatedDouble(&message, &field, k, before);
    }
  }
}

class HostileCalls : public HostileClients {
 protected:
  // Puts the worst numbers one by one into every place of a message, and has it sent.
  template <typename Send>
  static void spoil_all(Message& message, const Send& send) {
    for_each_double(message, [&](const auto& set, const std::string& field) {
      for (const double value : {kNan, kInfinity, -kInfinity, 1e308, -1e308, -1e-320, 5e-324}) {
        set(value);
        const grpc::Status status = send();
        const bool may_be_fine = std::isfinite(value) && std::abs(value) < 1;
        EXPECT_TRUE(status.error_code() == grpc::StatusCode::INVALID_ARGUMENT || (may_be_fine && status.ok()))
            << field << " = " << value << ": " << status.error_code() << " " << status.error_message();
      }
    });
  }

  static std::vector<v1::CreatePlanRequest> path_of(std::size_t points, bool stops) {
    std::vector<v1::CreatePlanRequest> messages = request_of(1, 0);
    messages.pop_back();
    constexpr std::size_t kChunk = 100'000;
    for (std::size_t first = 0; first < points; first += kChunk) {
      v1::PathChunk& chunk = *messages.emplace_back().mutable_path();
      chunk.add_feed_mm_s(50);
      chunk.mutable_points_mm()->Resize(3 * kChunk, 1.0);
      for (std::uint32_t point = 0; stops && point < kChunk; ++point) chunk.add_stops()->set_point(point);
    }
    return messages;
  }
};

TEST_F(HostileCalls, NumbersThatAreNoneAreRefusedWhereverTheyStand) {
  auto request = request_of(1, 3);
  v1::PlanOptions& options = *request[0].mutable_options();
  options.mutable_machine()->set_rapid_mm_s(100);
  v1::PathChunk& path = *request[1].mutable_path();
  path.add_tolerance_mm(0.01);  // as with the feed, one of its own for the first point would not be used
  path.add_stops()->set_point(2);
  spoil_all(options, [&] { return kcsd_.create(request).status; });
  spoil_all(path, [&] { return kcsd_.create(request).status; });
}

TEST_F(HostileCalls, NumbersThatAreNoneAreRefusedInStreamsAndLists) {
  const v1::Plan plan = kcsd_.create(request_of(1)).message;
  v1::StreamSetpointsRequest stream = setpoints(plan.name(), 0.1);
  spoil_all(stream, [&] { return kcsd_.stream(stream).status; });
  v1::PlanLiveRequest live;
  *live.mutable_options() = options(3);
  live.mutable_output()->set_period_s(0.1);
  spoil_all(*live.mutable_output(), [&] {
    Call call;
    const auto session = kcsd_.stub().PlanLive(&call);
    session->Write(live);
    session->WritesDone();
    v1::PlanLiveResponse response;
    while (session->Read(&response)) continue;
    return session->Finish();
  });
  for (const double value : {kNan, -kInfinity, -1e308}) {
    v1::ListPlansRequest list;
    list.mutable_filter()->set_cycle_time_at_most_s(value);
    Call call;
    v1::ListPlansResponse plans;
    EXPECT_EQ(kcsd_.stub().ListPlans(&call, list, &plans).error_code(), grpc::StatusCode::INVALID_ARGUMENT) << value;
  }
}

TEST_F(HostileCalls, HugeCountsAreRefused) {
  const v1::Plan plan = kcsd_.create(request_of(1)).message;
  const auto refused = [&](const auto& spoil) {
    v1::StreamSetpointsRequest request = setpoints(plan.name(), 0.1);
    spoil(request);
    return kcsd_.stream(request).status.error_code() == grpc::StatusCode::INVALID_ARGUMENT;
  };
  using Stream = v1::StreamSetpointsRequest;
  constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
  EXPECT_TRUE(refused([](Stream& stream) { stream.set_first_index(kMost); }));
  EXPECT_TRUE(refused([](Stream& stream) { stream.set_first_index(kMost / 2 + 1); }));
  EXPECT_TRUE(refused([](Stream& stream) { stream.set_batch_size(std::numeric_limits<std::uint32_t>::max()); }));
  EXPECT_TRUE(refused([](Stream& stream) {
    stream.set_first_index(1);
    stream.set_last_index(0);
  }));
  EXPECT_TRUE(refused([](Stream& stream) {
    for (int i = 0; i < 1'000'000; ++i) stream.add_channels(static_cast<v1::Channel>(99));
  }));
  Stream to_the_end = setpoints(plan.name(), 0.1);
  to_the_end.set_last_index(kMost);
  EXPECT_TRUE(kcsd_.stream(to_the_end).status.ok());

  auto arrays = request_of(1);
  arrays[0].mutable_options()->mutable_machine()->mutable_velocity_mm_s()->Resize(500'000, 100);
  EXPECT_EQ(kcsd_.create(arrays).status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  auto stops = request_of(1);
  for (int i = 0; i < 500'000; ++i) stops[1].mutable_path()->add_stops()->set_point(7);
  EXPECT_EQ(kcsd_.create(stops).status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  auto large = request_of(1);
  large[1].set_gcode(std::string(5'000'000, ' '));
  EXPECT_EQ(kcsd_.create(large).status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(kcsd_.get(std::string(3'000'000, 'x')).status.error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST_F(HostileCalls, AMillionMovesOfNoLengthArePlannedOrRefusedSoon) {
  for (const bool stops : {false, true}) {
    const grpc::Status status = kcsd_.create(path_of(1'000'000, stops)).status;
    EXPECT_TRUE(status.ok() || status.error_code() == grpc::StatusCode::INVALID_ARGUMENT)
        << status.error_code() << " " << status.error_message();
  }
  const grpc::Status beyond = kcsd_.create(path_of(1'100'000, false)).status;
  EXPECT_EQ(beyond.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << beyond.error_message();
}

TEST_F(HostileCalls, UploadsThatDoNotEndAreBoundedAndLeaveWithTheirClients) {
  constexpr std::size_t kUploads = 150;  // 128 are let in
  std::deque<Call> calls;
  std::deque<v1::Plan> plans;
  std::vector<std::unique_ptr<grpc::ClientWriter<v1::CreatePlanRequest>>> writers;
  const auto request = request_of(1);
  for (std::size_t i = 0; i < kUploads; ++i) {
    writers.push_back(kcsd_.stub().CreatePlan(&calls.emplace_back(), &plans.emplace_back()));
    writers.back()->Write(request[0]);
    if (i % 2 == 0) writers.back()->Write(request[1]);
  }
  EXPECT_TRUE(eventually(
      [&] { return kcsd_.create(request_of(2)).status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED; }));
  EXPECT_EQ(kcsd_.get("plans/none").status.error_code(), grpc::StatusCode::NOT_FOUND) << "other calls go on";
  for (Call& call : calls) call.TryCancel();
  for (const auto& writer : writers) EXPECT_FALSE(writer->Finish().ok());
  EXPECT_TRUE(eventually([&] { return kcsd_.create(request_of(2)).status.ok(); }));
}

TEST_F(HostileCalls, CancelledAtAnyMomentLeaveNothingBehind) {
  constexpr int kThreads = 4, kCalls = 100;
  const v1::Plan plan = kcsd_.create(request_of(1)).message;
  const auto stream = setpoints(plan.name(), 1e-5);
  std::vector<std::thread> clients;
  for (unsigned client = 0; client < kThreads; ++client) {
    clients.emplace_back([&, client] {
      std::mt19937 random(52 + client);
      const auto stub = v1::PlanningService::NewStub(new_channel(kcsd_.address()));
      for (unsigned number = 0; number < kCalls; ++number) {
        const std::chrono::microseconds life(random() % 20'000);
        Call call;
        std::thread killer([&] {
          std::this_thread::sleep_for(life);
          call.TryCancel();
        });
        if (number % 3 == 0) {
          const auto reader = stub->StreamSetpoints(&call, stream);
          for (v1::SetpointBatch batch; reader->Read(&batch);) continue;
          reader->Finish();
        } else if (number % 3 == 1) {
          v1::Plan made;
          const auto writer = stub->CreatePlan(&call, &made);
          auto messages = request_of(1'000 + client * kCalls + number, 3000);
          messages[0].set_accept_only(number % 2 == 0);
          for (const auto& message : messages) writer->Write(message);
          writer->WritesDone();
          writer->Finish();
        } else {
          const auto session = stub->PlanLive(&call);
          v1::PlanLiveRequest live;
          *live.mutable_options() = options(3);
          live.mutable_output()->set_period_s(1e-4);
          session->Write(live);
          live.Clear();
          *live.mutable_path() = request_of(number, 2000)[1].path();
          session->Write(live);
          session->WritesDone();
          for (v1::PlanLiveResponse response; session->Read(&response);) continue;
          session->Finish();
        }
        killer.join();
      }
    });
  }
  for (std::thread& client : clients) client.join();
  EXPECT_TRUE(eventually([&] {
    const std::string figures = kcsd_.page("/metrics").text;
    return figures.find("kcs_plans_running 0") != std::string::npos &&
           figures.find("kcs_planning_queue_depth 0") != std::string::npos;
  })) << "something is planned that nobody waits for";
}

}  // namespace
}  // namespace kcs::test
