// The request of CreatePlan, put together from the messages in which it comes.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <cstdint>
#include <optional>
#include <string_view>

#include "server/gcode/reader.h"
#include "server/jobs/plan_request.h"
#include "server/jobs/request_digest.h"
#include "server/service/caps.h"
#include "server/service/path_decoder.h"

namespace kcs::service {

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
  jobs::PlanRequest finish();

 private:
  void add_options(const v1::PlanOptions& message);
  void add_path(const v1::PathChunk& chunk);
  void add_gcode(std::string_view text);
  // Calls the G-code reader, and names the server's own cap where the reader reaches it.
  template <typename Read>
  void within_caps(const Read& read) const;

  const Caps& caps_;
  std::optional<jobs::RequestOptions> options_;
  // One of these two, from the first piece of the path on.
  std::optional<PathDecoder> path_;
  std::optional<gcode::Reader> gcode_;
  planning::Toolpath gcode_path_;
  std::optional<jobs::RequestDigest> digest_;
  std::uint64_t gcode_bytes_ = 0;
};

}  // namespace kcs::service
