// Calls of PlanLive, and what comes of them.
#pragma once

#include <thread>
#include <vector>

#include "tests/service/test_server.h"

namespace kcs::service::test {

struct LiveAnswer {
  grpc::Status status;
  std::vector<v1::SetpointBatch> setpoints;
  std::vector<v1::Corner> corners;
  std::vector<v1::Plan> plans;  // one if all is well
};

// The same messages for PlanLive; the first one asks for `output`.
std::vector<v1::PlanLiveRequest> live(const std::vector<v1::CreatePlanRequest>& messages, const v1::LiveOutput& output);

// Position at a period.
v1::LiveOutput every(double period);

// A call that reads in the thread that asks, and writes in one of its own.
class LiveClient {
 public:
  explicit LiveClient(TestServer& server) : stream_(server.stub().PlanLive(&call_)) {}

  // One message, from this thread; false if the server takes no more.
  bool write(const v1::PlanLiveRequest& message) { return stream_->Write(message); }
  void end_path() { stream_->WritesDone(); }
  // The next answer; false if there is none.
  bool read(v1::PlanLiveResponse& response) { return stream_->Read(&response); }
  void cancel() { call_.TryCancel(); }

  // Everything that still comes.
  LiveAnswer read_all();
  // Writes the messages while it reads everything.
  LiveAnswer exchange(const std::vector<v1::PlanLiveRequest>& messages);

 private:
  Call call_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::PlanLiveRequest, v1::PlanLiveResponse>> stream_;
};

}  // namespace kcs::service::test
