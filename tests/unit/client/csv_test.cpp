#include "client/cli/csv.h"

#include <gtest/gtest.h>

namespace kcs::cli {
namespace {

using client::Channel;

TEST(Csv, HeaderNamesTheColumnsOfTheMachine) {
  EXPECT_EQ(csv_header({3, {}}), "t,x,y,z\n");
  EXPECT_EQ(csv_header({2, {}}), "t,x,y\n");
  EXPECT_EQ(csv_header({2, {Channel::kJerk, Channel::kVelocity}}), "t,x,y,vx,vy,jx,jy\n");
  EXPECT_EQ(csv_header({3, {Channel::kVelocity, Channel::kAcceleration, Channel::kJerk}}),
            "t,x,y,z,vx,vy,vz,ax,ay,az,jx,jy,jz\n");
  EXPECT_EQ(csv_header({2, {Channel::kLine, Channel::kSegment, Channel::kVelocity, Channel::kPathPosition}}),
            "t,x,y,vx,vy,path_position,segment,line\n");
}

TEST(Csv, RowsHaveFifteenSignificantDigits) {
  client::SetpointBatch batch;
  batch.position_mm = {{1.0 / 3}, {-123456.789012345678}};
  EXPECT_EQ(csv_rows(batch, 0.001), "0,0.333333333333333,-123456.789012346\n");
}

TEST(Csv, TimesAreMultiplesOfThePeriod) {
  client::SetpointBatch batch;
  batch.first_index = 2;
  batch.position_mm = {{1, 2}, {3, 4}};
  EXPECT_EQ(csv_rows(batch, 0.1), "0.2,1,3\n0.3,2,4\n");
}

TEST(Csv, ChannelsFollowThePosition) {
  client::SetpointBatch batch;
  batch.position_mm = {{1}, {2}};
  batch.velocity_mm_s = {{3}, {4}};
  batch.acceleration_mm_s2 = {{5}, {6}};
  batch.jerk_mm_s3 = {{7}, {8}};
  EXPECT_EQ(csv_rows(batch, 1), "0,1,2,3,4,5,6,7,8\n");
  batch.path_position_mm = {9.5};
  batch.segment = {10};
  batch.line = {4'294'967'295};
  EXPECT_EQ(csv_rows(batch, 1), "0,1,2,3,4,5,6,7,8,9.5,10,4294967295\n");
}

TEST(Streamer, RowsHaveNeitherTimeNorCommas) {
  client::SetpointBatch batch;
  batch.first_index = 2;
  batch.position_mm = {{1, 2}, {0.1, -4}};
  batch.velocity_mm_s = {{5, 6}, {7, 8}};
  EXPECT_EQ(streamer_rows(batch), "1 0.1 5 7\n2 -4 6 8\n");
  batch.line = {12, 13};
  EXPECT_EQ(streamer_rows(batch), "1 0.1 5 7 12\n2 -4 6 8 13\n");
}

}  // namespace
}  // namespace kcs::cli
