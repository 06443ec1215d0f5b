// Requests as bytes, for the store.
#pragma once

#include <string>
#include <string_view>

#include "server/jobs/plan_request.h"
#include "server/service/caps.h"

namespace kcs::service {

// gcode: the program that the request's path was read from; empty if it came as points.
std::string encode_request(const jobs::PlanRequest& request, std::string_view gcode);

// The request again. Throws what an upload of it throws (upload.h): a cap may have become smaller; std::runtime_error
// if the bytes are damaged.
jobs::PlanRequest decode_request(const std::string& name, const std::string& bytes, const Caps& caps);

}  // namespace kcs::service
