#include "server/service/pace.h"

#include <algorithm>
#include <utility>

#include "server/motion/setpoint.h"
#include "server/service/status.h"
#include "server/service/violations.h"

namespace kcs::service {
namespace {

constexpr double kMostLead = 3600;          // s
constexpr double kCancellationCheck = 0.1;  // s: gRPC does not tell a waiting thread that the client is gone

}  // namespace

Pace::Pace(const v1::StreamSetpointsRequest& request, std::stop_token stop, std::function<bool()> is_cancelled)
    : stop_(std::move(stop)),
      is_cancelled_(std::move(is_cancelled)),
      has_lead_(request.has_lead_s()),
      lead_(request.lead_s()),
      period_(request.period_s()),
      start_index_(request.first_index()) {
  Violations violations;
  violations.check_range("lead_s", lead_, 0, kMostLead, "s");
  violations.refuse();
}

void Pace::wait_for(std::uint64_t first_index) {
  if (stop_.stop_requested()) throw Stopping();
  if (!has_lead_) return;
  std::unique_lock lock(mutex_);
  while (true) {
    const double left = time_left(first_index);
    if (left <= 0) return;
    if (is_cancelled_()) throw Cancelled();
    const std::chrono::duration<double> step(std::min(left, kCancellationCheck));
    never_.wait_for(lock, stop_, step, [] { return false; });
    if (stop_.stop_requested()) throw Stopping();
  }
}

double Pace::time_left(std::uint64_t first_index) const {
  const std::chrono::duration<double> elapsed = Clock::now() - start_;
  return motion::setpoint_time(first_index - start_index_, period_) - lead_ - elapsed.count();
}

}  // namespace kcs::service
