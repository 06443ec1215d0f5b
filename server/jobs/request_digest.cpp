#include "server/jobs/request_digest.h"

#include <array>
#include <bit>
#include <stdexcept>

namespace kcs::jobs {
namespace {

constexpr std::size_t kBufferSize = 4096;

void require(bool succeeded) {
  if (!succeeded) throw std::runtime_error("SHA-256 failed in the cryptographic library");
}

}  // namespace

RequestDigest::RequestDigest(const RequestOptions& options)
    : axes_(options.planning.limits.axes), context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
  require(context_ != nullptr);
  require(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  add(std::uint64_t{options.machine_name.size()});
  add(std::string_view(options.machine_name));
  add(std::uint64_t{axes_});
  add(options.planning.limits.velocity);
  add(options.planning.limits.acceleration);
  add(options.planning.limits.jerk);
  add(options.rapid);
  add(options.tolerance);
  add(static_cast<std::uint64_t>(options.planning.tolerance_kind));
  add(static_cast<std::uint64_t>(options.planning.strategy));
  add(options.feed);
  const bool in_motion = options.start_speed != 0 || options.start_acceleration != 0 || options.end_speed != 0;
  add(std::uint64_t{in_motion} << 1 | std::uint64_t{options.start.has_value()});
  if (options.start) add(*options.start);
  if (in_motion) {
    add(options.start_speed);
    add(options.start_acceleration);
    add(options.end_speed);
  }
}

void RequestDigest::add(const planning::Segment& segment) {
  add(segment.end);
  add(segment.feed);
  add(segment.tolerance);
  add(segment.dwell);
  const planning::Marker& marker = segment.marker;
  add(static_cast<std::uint64_t>(marker.kind) << 40 | std::uint64_t{segment.line} << 1 | std::uint64_t{segment.stop});
  if (marker.kind != planning::MarkerKind::kNone) add(double{marker.speed});
}

void RequestDigest::add(std::string_view gcode) {
  flush();
  require(EVP_DigestUpdate(context_.get(), gcode.data(), gcode.size()) == 1);
}

std::string RequestDigest::finish() {
  flush();
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  require(EVP_DigestFinal_ex(context_.get(), digest.data(), &size) == 1);
  std::string name = "plans/";
  for (unsigned i = 0; i < size; ++i) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    name.push_back(kDigits[digest[i] >> 4]);
    name.push_back(kDigits[digest[i] & 0xf]);
  }
  return name;
}

void RequestDigest::add(double value) { add(std::bit_cast<std::uint64_t>(value + 0.0)); }

void RequestDigest::add(std::uint64_t value) {
  // Byte by byte, so that the name does not depend on the machine's byte order.
  for (unsigned shift = 0; shift < 64; shift += 8) buffer_.push_back(static_cast<char>(value >> shift & 0xff));
  if (buffer_.size() >= kBufferSize) flush();
}

void RequestDigest::add(const planning::Vector& vector) {
  for (std::size_t axis = 0; axis < axes_; ++axis) add(vector[static_cast<Eigen::Index>(axis)]);
}

void RequestDigest::add(const std::optional<double>& value) {
  add(std::uint64_t{value.has_value()});
  if (value) add(*value);
}

void RequestDigest::flush() {
  require(EVP_DigestUpdate(context_.get(), buffer_.data(), buffer_.size()) == 1);
  buffer_.clear();
}

}  // namespace kcs::jobs
