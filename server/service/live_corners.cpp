#include "server/service/live_corners.h"

#include <utility>

#include "server/service/encode.h"

namespace kcs::service {

LiveCorners::LiveCorners(const planning::PlanOptions& options, SendLive send)
    : options_(options), send_(std::move(send)) {}

void LiveCorners::add(const planning::Corner& corner) {
  encode_corner(corner, options_, *response_.mutable_corners()->add_corners());
  if (response_.corners().corners_size() == kCornersPerBatch) flush();
}

void LiveCorners::flush() {
  if (response_.corners().corners().empty()) return;
  send_(response_);
  response_.mutable_corners()->clear_corners();
}

}  // namespace kcs::service
