#include "client/cli/npy.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

namespace kcs::cli {
namespace {

using client::Channel;

constexpr std::size_t kHead = 512;

TEST(Npy, IsAnArrayOfRecords) {
  std::stringstream file;
  NpyWriter writer({2, {Channel::kSegment}, 0.5}, file);
  client::SetpointBatch batch;
  batch.first_index = 0;
  batch.position_mm = {{1, 2}, {-3, 0.1}};
  batch.segment = {7, 8};
  writer.add(batch);
  batch.first_index = 2;
  batch.position_mm = {{4}, {5}};
  batch.segment = {9};
  writer.add(batch);
  writer.finish();

  const std::string bytes = file.str();
  ASSERT_EQ(bytes.size(), kHead + 3 * 4 * sizeof(double));
  EXPECT_EQ(bytes.substr(0, 10), std::string("\x93NUMPY\x01\x00\xf6\x01", 10));  // 502 bytes follow
  const std::string head = bytes.substr(10, kHead - 10);
  EXPECT_EQ(head.substr(0, head.find_last_not_of(" \n") + 1),
            "{'descr': [('t', '<f8'), ('x', '<f8'), ('y', '<f8'), ('segment', '<u8'), ], 'fortran_order': False, "
            "'shape': (3,), }");
  EXPECT_EQ(head.back(), '\n');
  const auto number = [&bytes]<typename Number>(std::size_t index, Number value) {
    std::memcpy(&value, bytes.data() + kHead + index * sizeof(Number), sizeof(Number));
    return value;
  };
  EXPECT_EQ(number(4, 0.0), 0.5);  // the second record
  EXPECT_EQ(number(5, 0.0), 2);
  EXPECT_EQ(number(6, 0.0), 0.1);
  EXPECT_EQ(number(7, std::uint64_t{}), 8U);
  EXPECT_EQ(number(8, 0.0), 1.0);  // the third
}

TEST(Npy, WritesLinesInFourBytes) {
  std::stringstream file;
  NpyWriter writer({2, {Channel::kLine}, 1}, file);
  client::SetpointBatch batch;
  batch.position_mm = {{1, 2}, {3, 4}};
  batch.line = {7, 4'294'967'295};
  writer.add(batch);
  writer.finish();
  const std::string bytes = file.str();
  constexpr std::size_t kRecord = 3 * sizeof(double) + sizeof(std::uint32_t);
  ASSERT_EQ(bytes.size(), kHead + 2 * kRecord);
  EXPECT_EQ(bytes.substr(kHead + kRecord - 4, 4), std::string("\x07\x00\x00\x00", 4));
  EXPECT_EQ(bytes.substr(kHead + 2 * kRecord - 4), "\xff\xff\xff\xff");
}

TEST(Npy, HasRoomForEveryColumn) {
  std::stringstream file;
  const SetpointColumns columns{3,
                                {Channel::kVelocity, Channel::kAcceleration, Channel::kJerk, Channel::kPathPosition,
                                 Channel::kSegment, Channel::kLine},
                                1};
  NpyWriter(columns, file).finish();
  EXPECT_EQ(file.str().size(), kHead);
  EXPECT_NE(file.str().find("('segment', '<u8'), ('line', '<u4'), ], 'fortran_order': False, 'shape': (0,), }"),
            std::string::npos);
}

}  // namespace
}  // namespace kcs::cli
