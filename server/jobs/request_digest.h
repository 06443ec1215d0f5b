// The name of a plan: the SHA-256 of its request.
#pragma once

#include <openssl/evp.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "server/jobs/plan_request.h"

namespace kcs::jobs {

// Takes a request in a canonical form and tells the plan's name at the end. What counts is what the request says, not
// how it was cut into messages, nor whether a default was spelt out.
// Throws std::runtime_error if the cryptographic library fails.
class RequestDigest {
 public:
  // Starts with the options. Whether they have a start tells G-code from points.
  explicit RequestDigest(const RequestOptions& options);

  // Adds the start of a path of points.
  void add(const planning::Vector& start);
  // Adds its next segment.
  void add(const planning::Segment& segment);
  // Adds the next bytes of a G-code program.
  void add(std::string_view gcode);

  // "plans/" and 64 hexadecimal digits. Ends the digest: nothing can be added afterwards.
  std::string finish();

 private:
  void add(double value);  // −0 counts as 0
  void add(std::uint64_t value);
  void add(const std::optional<double>& value);
  void flush();

  std::size_t axes_;
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
  std::string buffer_;  // many small values, few calls
};

}  // namespace kcs::jobs
