// Hands things from one thread to one other without either ever waiting for a lock.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace kcs::gateway {

// A queue of fixed capacity between exactly one thread that puts and one that takes. All memory is allocated when it is
// made; put and take neither allocate nor block nor make system calls, so a real-time thread can stand at either end.
template <typename Item>
class OneWayQueue {
 public:
  // capacity: the most items that it holds, at least 1.
  explicit OneWayQueue(std::size_t capacity) : slots_(capacity + 1) {}  // one stays free: full is not empty

  std::size_t capacity() const { return slots_.size() - 1; }

  // Adds an item; false if the queue is full. For the putting thread.
  bool put(const Item& item) {
    const std::size_t last = last_.load(std::memory_order_relaxed);
    const std::size_t next = after(last);
    if (next == first_.load(std::memory_order_acquire)) return false;
    slots_[last] = item;
    last_.store(next, std::memory_order_release);
    return true;
  }

  // Moves the oldest item into `item`; false if there is none. For the taking thread.
  bool take(Item& item) {
    const std::size_t first = first_.load(std::memory_order_relaxed);
    if (first == last_.load(std::memory_order_acquire)) return false;
    item = slots_[first];
    first_.store(after(first), std::memory_order_release);
    return true;
  }

  // Number of items; exact for the thread that puts or takes at the time, an instant old for everyone else.
  std::size_t size() const {
    const std::size_t first = first_.load(std::memory_order_acquire);
    const std::size_t last = last_.load(std::memory_order_acquire);
    return last >= first ? last - first : last + slots_.size() - first;
  }

  bool empty() const { return size() == 0; }

 private:
  std::size_t after(std::size_t slot) const { return slot + 1 == slots_.size() ? 0 : slot + 1; }

  // What the two threads write lies in different cache lines, so that neither slows the other.
  static constexpr std::size_t kCacheLine = 64;

  alignas(kCacheLine) std::atomic<std::size_t> first_ = 0;  // oldest item; written by the taking thread
  alignas(kCacheLine) std::atomic<std::size_t> last_ = 0;   // first free slot; written by the putting thread
  std::vector<Item> slots_;
};

}  // namespace kcs::gateway
