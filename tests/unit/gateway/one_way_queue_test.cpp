#include "client/gateway/one_way_queue.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <thread>

namespace kcs::gateway {
namespace {

TEST(OneWayQueue, GivesBackInOrderWhatWasPut) {
  OneWayQueue<int> queue(3);
  int item = 0;
  EXPECT_FALSE(queue.take(item));
  for (int round = 0; round < 10; ++round) {
    EXPECT_TRUE(queue.put(2 * round));
    EXPECT_TRUE(queue.put(2 * round + 1));
    ASSERT_TRUE(queue.take(item));
    EXPECT_EQ(item, 2 * round);
    ASSERT_TRUE(queue.take(item));
    EXPECT_EQ(item, 2 * round + 1);
  }
  EXPECT_TRUE(queue.empty());
}

TEST(OneWayQueue, HoldsJustItsCapacity) {
  OneWayQueue<int> queue(3);
  EXPECT_EQ(queue.capacity(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(queue.put(i));
  EXPECT_EQ(queue.size(), 3u);
  EXPECT_FALSE(queue.put(3));
  int item = -1;
  EXPECT_TRUE(queue.take(item));
  EXPECT_EQ(item, 0);
  EXPECT_EQ(queue.size(), 2u);
  EXPECT_TRUE(queue.put(3));
}

// Under ThreadSanitizer this also shows that what one thread put, the other may read.
TEST(OneWayQueue, LosesRepeatsAndTearsNothingBetweenTwoThreads) {
  using Item = std::array<std::uint64_t, 4>;
  constexpr std::uint64_t kItems = 200'000;
  OneWayQueue<Item> queue(7);
  std::jthread putting([&queue] {
    for (std::uint64_t i = 0; i < kItems; ++i) {
      while (!queue.put({i, i, i, i})) std::this_thread::yield();
    }
  });
  std::uint64_t wrong = 0;
  for (std::uint64_t i = 0; i < kItems; ++i) {
    Item item;
    while (!queue.take(item)) std::this_thread::yield();
    if (item != Item{i, i, i, i} || queue.size() > queue.capacity()) ++wrong;
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace kcs::gateway
