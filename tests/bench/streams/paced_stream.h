// A client that takes setpoints at the pace of the machine and writes down when they come.
#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/support/client_callback.h>
#include <kcs/v1/planning.grpc.pb.h>

#include <chrono>
#include <cstdint>
#include <future>
#include <string>
#include <vector>

namespace kcs::bench {

inline constexpr double kLate = 0.01;  // s: what comes later than this is late

// One call of StreamSetpoints, without a thread of its own: a thousand of them take two.
class PacedStream final : public grpc::ClientReadReactor<v1::SetpointBatch> {
 public:
  // Calls at once; the request has lead_s. The stub must outlive the stream.
  PacedStream(v1::PlanningService::Stub& stub, const v1::StreamSetpointsRequest& request);

  // Waits for the end of the stream. Returns what is wrong with it, or nothing.
  std::string finish();

  // After finish(): how much later than it was due each batch came, s. A setpoint's time counts from the call on, and a
  // batch is due lead_s before the time of its first setpoint.
  const std::vector<float>& delays() const { return delays_; }
  // Those that came late, measured by their own times.
  std::uint64_t late_setpoints() const { return late_; }

 private:
  using Clock = std::chrono::steady_clock;

  void OnReadDone(bool ok) override;
  void OnDone(const grpc::Status& status) override;

  const double period_, lead_;  // s
  grpc::ClientContext context_;
  v1::SetpointBatch batch_;
  std::uint64_t next_ = 0;  // setpoint that is to come
  std::uint64_t late_ = 0;
  bool complete_ = true;  // so far, none is missing
  std::vector<float> delays_;
  std::promise<grpc::Status> done_;
  const Clock::time_point start_;
};

}  // namespace kcs::bench
