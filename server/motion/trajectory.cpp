#include "server/motion/trajectory.h"

#include <algorithm>

namespace kcs::motion {
namespace {

// Phases in a block: few, so that going to any time takes a microsecond; many, so that the first ones cost little.
constexpr std::uint32_t kBlockSize = 64;

}  // namespace

void Trajectory::append(const Phase& phase) {
  ++size_;
  if (blocks_.empty() || blocks_.back().others + 1 == kBlockSize || !last_->can_write(phase)) {
    if (!blocks_.empty()) blocks_.back().packed.shrink_to_fit();
    blocks_.push_back({phase});
    last_.emplace(phase);
    return;
  }
  Block& block = blocks_.back();
  block.packed.resize(block.packed.size() - PhaseCode::kPadding);
  last_->write(phase, block.packed);
  block.packed.resize(block.packed.size() + PhaseCode::kPadding);
  ++block.others;
}

std::size_t Trajectory::bytes() const {
  std::size_t bytes = sizeof *this + blocks_.size() * sizeof(Block);
  for (const Block& block : blocks_) bytes += block.packed.capacity();
  return bytes;
}

Trajectory::Iterator Trajectory::begin() const { return {*this, 0}; }

Trajectory::Iterator::Iterator(const Trajectory& trajectory, std::size_t block) : trajectory_(&trajectory), code_({}) {
  enter(block);
}

void Trajectory::Iterator::enter(std::size_t block) {
  block_ = block;
  if (block == trajectory_->blocks_.size()) return;
  const Block& entered = trajectory_->blocks_[block];
  left_ = entered.others;
  next_ = entered.packed.data();
  code_ = PhaseCode(entered.first);
}

Trajectory::Iterator& Trajectory::Iterator::operator++() {
  if (left_ == 0) {
    enter(block_ + 1);
  } else {
    --left_;
    next_ = code_.read(next_);
  }
  return *this;
}

void Trajectory::Iterator::seek(double time) {
  const auto& blocks = trajectory_->blocks_;
  if (*this == trajectory_->end() || time < code_.phase().start_time ||
      (block_ + 1 < blocks.size() && time >= blocks[block_ + 1].first.start_time)) {
    const auto after = std::upper_bound(blocks.begin(), blocks.end(), time,
                                        [](double t, const Block& block) { return t < block.first.start_time; });
    enter(after == blocks.begin() ? 0 : static_cast<std::size_t>(after - blocks.begin()) - 1);
  }
  while (left_ > 0 && time >= code_.phase().end_time()) ++*this;
}

}  // namespace kcs::motion
