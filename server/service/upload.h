// The request of CreatePlan, put together from the messages in which it comes.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <optional>
#include <string>

#include "server/jobs/fair_queue.h"
#include "server/jobs/plan_request.h"
#include "server/service/caps.h"
#include "server/service/incoming_path.h"

namespace kcs::service {

// What a client asks for.
struct Uploaded {
  jobs::PlanRequest request;
  std::string gcode;  // that the path was read from; empty if it came as points
  jobs::Priority priority = jobs::Priority::kNormal;
  bool accept_only = false;
};

// Checks every message as it comes: a request that is going to be refused is refused at once, not after its upload.
// Both methods throw planning::InvalidInput and jobs::CapExceeded.
class Upload {
 public:
  // Keeps a reference to `caps`.
  explicit Upload(const Caps& caps) : caps_(caps) {}
  // Its parts refer to each other.
  Upload(const Upload&) = delete;
  Upload& operator=(const Upload&) = delete;

  void add(const v1::CreatePlanRequest& message);

  // After the last message.
  Uploaded finish();

 private:
  void take_manner(const v1::CreatePlanRequest& message);
  void begin(const v1::PlanOptions& options);

  const Caps& caps_;
  std::optional<IncomingPath> incoming_;  // once the options came
  Uploaded uploaded_;
};

}  // namespace kcs::service
