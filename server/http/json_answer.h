// What is answered over HTTP, as JSON.
#pragma once

#include <grpcpp/support/status.h>
#include <kcs/v1/planning.pb.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace kcs::http {

// A status of HTTP and a JSON object.
struct Answer {
  int status = 200;
  nlohmann::ordered_json body;
  std::optional<long> retry_after_s{};  // trying again may help, but not before
};

// A plan, with the names and units of planning.proto. slow_spots: of SlowSpots.
Answer answer_of(const v1::Plan& plan, nlohmann::ordered_json slow_spots);

// A refusal that the service itself does not know.
Answer refusal(int status, const std::string& code, const std::string& message, const std::string& field = "");

// The failure of a call: its code, message, and what is wrong where. `status` must not be OK.
Answer answer_of(const grpc::Status& status);

}  // namespace kcs::http
