// The corners of a plan, in little memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>

#include "server/planning/corner.h"

namespace kcs::planning {

// Grows at its end; 80 bytes for a corner that is one of many in one smooth motion, 104 for any other. What is read is
// what was appended.
class CornerList {
 public:
  class Iterator;
  using value_type = Corner;
  using const_iterator = Iterator;

  void append(const Corner& corner);

  std::size_t size() const { return corners_.size(); }
  bool empty() const { return corners_.empty(); }
  Corner operator[](std::size_t i) const;
  std::size_t bytes() const { return corners_.size() * sizeof(Packed) + timings_.size() * sizeof(Timing); }

  Iterator begin() const;
  Iterator end() const;

 private:
  // What only corners with a beginning and an end of their own have.
  struct Timing {
    double boundary_acceleration, duration, dwell;
  };
  struct Packed {
    Vector point;
    double angle, speed, corner_distance, contour_error, time_lost;
    std::uint32_t segment, line;
    std::uint32_t timing;  // one more than its index; 0: none
    CornerStrategy strategy;
  };

  std::deque<Packed> corners_;
  std::deque<Timing> timings_;
};

class CornerList::Iterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = Corner;
  using difference_type = std::ptrdiff_t;
  using pointer = const Corner*;
  using reference = Corner;

  Iterator() = default;
  Iterator(const CornerList& list, std::size_t index) : list_(&list), index_(index) {}

  Corner operator*() const { return (*list_)[index_]; }
  Iterator& operator++() {
    ++index_;
    return *this;
  }
  Iterator operator++(int) {
    Iterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const Iterator& other) const = default;

 private:
  const CornerList* list_ = nullptr;
  std::size_t index_ = 0;
};

inline CornerList::Iterator CornerList::begin() const { return {*this, 0}; }
inline CornerList::Iterator CornerList::end() const { return {*this, size()}; }

}  // namespace kcs::planning
