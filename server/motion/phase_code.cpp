#include "server/motion/phase_code.h"

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace kcs::motion {
namespace {

static_assert(std::endian::native == std::endian::little);

// A phase begins with 32 bits of codes, in the order of the fields: two bits for each number, three for each of the
// segments. Numbers follow where their codes say so.

// How many bytes tell a number's difference from what was expected, by code.
constexpr std::array<unsigned, 4> kLengths{0, 1, 2, 8};
constexpr std::array<std::uint64_t, 4> kMasks{0, 0xff, 0xffff, ~std::uint64_t{0}};

// An axis' jerk is none, as great as its last one was, or told in full.
enum JerkCode : unsigned { kNoJerk, kSameJerk, kOppositeJerk, kOtherJerk };

// The greatest difference of segment numbers with a code of its own.
constexpr std::uint32_t kMostSegments = 6;
constexpr unsigned kMoreSegments = kMostSegments + 1;

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

// Which of all its bits a NaN gets when it is calculated is left to the compiler, here and there: nothing is expected
// then.
std::uint64_t expected_bits(double expected) { return std::isnan(expected) ? 0 : bits(expected); }

template <class Number>
Number load(const std::byte* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

void store(std::uint64_t number, unsigned length, std::vector<std::byte>& bytes) {
  for (unsigned i = 0; i < length; ++i) bytes.push_back(static_cast<std::byte>(number >> (8 * i)));
}

class Writer {
 public:
  explicit Writer(std::vector<std::byte>& bytes) : bytes_(bytes), start_(bytes.size()) {
    store(0, sizeof codes_, bytes);
  }

  void near(double expected, double value) {
    // Neighbouring doubles have neighbouring bits. The sign goes last: a small difference is a small number.
    const std::uint64_t difference = bits(value) - expected_bits(expected);
    const std::uint64_t number = difference << 1 ^ (difference >> 63 != 0 ? kMasks[3] : 0);
    unsigned code = 0;
    while (number > kMasks[code]) ++code;
    put(code, 2);
    store(number, kLengths[code], bytes_);
  }

  void jerk(double last, double value) {
    const JerkCode code = bits(value) == 0             ? kNoJerk
                          : bits(value) == bits(last)  ? kSameJerk
                          : bits(value) == bits(-last) ? kOppositeJerk
                                                       : kOtherJerk;
    put(code, 2);
    if (code == kOtherJerk) store(bits(value), sizeof value, bytes_);
  }

  void segments(std::uint32_t from, std::uint32_t to) {
    const std::uint32_t difference = to - from;
    put(std::min(difference, kMoreSegments), 3);
    if (difference > kMostSegments) store(difference, sizeof difference, bytes_);
  }

  void finish() { std::memcpy(&bytes_[start_], &codes_, sizeof codes_); }

 private:
  void put(unsigned code, unsigned width) {
    codes_ |= code << used_;
    used_ += width;
  }

  std::vector<std::byte>& bytes_;
  std::size_t start_;
  std::uint32_t codes_ = 0;
  unsigned used_ = 0;
};

class Reader {
 public:
  explicit Reader(const std::byte* bytes) : codes_(load<std::uint32_t>(bytes)), next_(bytes + sizeof codes_) {}

  double near(double expected) {
    const unsigned code = take(2);
    const std::uint64_t number = load<std::uint64_t>(next_) & kMasks[code];
    next_ += kLengths[code];
    return std::bit_cast<double>(expected_bits(expected) + (number >> 1 ^ -(number & 1)));
  }

  double jerk(double last) {
    switch (take(2)) {
      case kNoJerk:
        return 0;
      case kSameJerk:
        return last;
      case kOppositeJerk:
        return -last;
      default:
        return std::bit_cast<double>(load<std::uint64_t>(std::exchange(next_, next_ + sizeof(double))));
    }
  }

  std::uint32_t segments(std::uint32_t from) {
    const unsigned code = take(3);
    if (code < kMoreSegments) return from + code;
    return from + load<std::uint32_t>(std::exchange(next_, next_ + sizeof from));
  }

  const std::byte* next() const { return next_; }

 private:
  unsigned take(unsigned width) {
    const unsigned code = codes_ & ((1u << width) - 1);
    codes_ >>= width;
    return code;
  }

  std::uint32_t codes_;
  const std::byte* next_;
};

}  // namespace

void PhaseCode::write(const Phase& next, std::vector<std::byte>& bytes) {
  const State expected = phase_.at(phase_.duration);
  Writer writer(bytes);
  writer.near(phase_.duration, next.duration);
  for (int axis = 0; axis < 3; ++axis) {
    writer.near(expected.position[axis], next.start.position[axis]);
    writer.near(expected.velocity[axis], next.start.velocity[axis]);
    writer.near(expected.acceleration[axis], next.start.acceleration[axis]);
    writer.jerk(jerk_[axis], next.jerk[axis]);
    if (next.jerk[axis] != 0) jerk_[axis] = next.jerk[axis];
  }
  writer.segments(phase_.segments.first, next.segments.first);
  writer.segments(next.segments.first, next.segments.last);
  writer.finish();
  phase_ = next;
}

const std::byte* PhaseCode::read(const std::byte* bytes) {
  const State expected = phase_.at(phase_.duration);
  Reader reader(bytes);
  phase_.start_time = phase_.end_time();
  phase_.duration = reader.near(phase_.duration);
  for (int axis = 0; axis < 3; ++axis) {
    phase_.start.position[axis] = reader.near(expected.position[axis]);
    phase_.start.velocity[axis] = reader.near(expected.velocity[axis]);
    phase_.start.acceleration[axis] = reader.near(expected.acceleration[axis]);
    phase_.jerk[axis] = reader.jerk(jerk_[axis]);
    if (phase_.jerk[axis] != 0) jerk_[axis] = phase_.jerk[axis];
  }
  phase_.segments.first = reader.segments(phase_.segments.first);
  phase_.segments.last = reader.segments(phase_.segments.first);
  return reader.next();
}

}  // namespace kcs::motion
