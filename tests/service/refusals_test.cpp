// Requests that cannot be planned: each is refused with the field and the reason, and the server goes on serving.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "server/service/status.h"
#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

class Refusals : public ::testing::Test {
 protected:
  void TearDown() override {
    EXPECT_TRUE(server_.create({request(options()), request(right_angle())}).status.ok()) << "serves no more";
  }

  grpc::Status create(const std::vector<v1::CreatePlanRequest>& messages) { return server_.create(messages).status; }

  template <typename Change>
  void refused_options(const std::string& field, const Change& change) {
    v1::PlanOptions bad = options(3);
    change(bad);
    EXPECT_TRUE(refuses_field(create({request(bad), gcode("F100\nG1 X10\n")}), field)) << bad.ShortDebugString();
  }

  template <typename Change>
  void refused_path(const std::string& field, const Change& change) {
    v1::PathChunk bad = path({0, 0, 10, 0, 10, 10, 20, 10});
    change(bad);
    EXPECT_TRUE(refuses_field(create({request(options()), request(bad)}), field)) << bad.ShortDebugString();
  }

  TestServer server_;
};

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kAbsurd[] = {kNan, kInfinity, -kInfinity, 1e308, -1e308, -1};

TEST_F(Refusals, MachineWithoutTwoOrThreeAxes) {
  for (const std::uint32_t axes : {0U, 1U, 4U, std::numeric_limits<std::uint32_t>::max()}) {
    refused_options("options.machine.axes", [axes](auto& options) { options.mutable_machine()->set_axes(axes); });
  }
  refused_options("options.machine", [](auto& options) { options.clear_machine(); });
}

TEST_F(Refusals, AbsurdLimits) {
  for (const double bad : {kNan, kInfinity, 1e308, -1.0, 0.0, 5e-324}) {
    refused_options("options.machine.velocity_mm_s[0]",
                    [bad](auto& options) { options.mutable_machine()->set_velocity_mm_s(0, bad); });
    refused_options("options.machine.acceleration_mm_s2[2]",
                    [bad](auto& options) { options.mutable_machine()->set_acceleration_mm_s2(2, bad); });
    refused_options("options.machine.jerk_mm_s3[1]",
                    [bad](auto& options) { options.mutable_machine()->set_jerk_mm_s3(1, bad); });
    refused_options("options.machine.rapid_mm_s",
                    [bad](auto& options) { options.mutable_machine()->set_rapid_mm_s(bad); });
    refused_options("options.feed_mm_s", [bad](auto& options) { options.set_feed_mm_s(bad); });
  }
}

TEST_F(Refusals, ArraysThatDoNotFitTheAxes) {
  refused_options("options.machine.velocity_mm_s",
                  [](auto& options) { options.mutable_machine()->add_velocity_mm_s(1); });
  refused_options("options.machine.acceleration_mm_s2",
                  [](auto& options) { options.mutable_machine()->clear_acceleration_mm_s2(); });
  refused_options("options.machine.jerk_mm_s3",
                  [](auto& options) { options.mutable_machine()->mutable_jerk_mm_s3()->Resize(100'000, 1); });
  refused_options("options.start_mm", [](auto& options) { options.add_start_mm(0); });
}

TEST_F(Refusals, AbsurdTolerancesStartsAndNames) {
  for (const double bad : kAbsurd) {
    refused_options("options.tolerance_mm", [bad](auto& options) { options.set_tolerance_mm(bad); });
  }
  for (const double bad : {kNan, kInfinity, -1e308}) {
    refused_options("options.start_mm[1]", [bad](auto& options) {
      options.mutable_start_mm()->Resize(3, 0);
      options.set_start_mm(1, bad);
    });
  }
  refused_options("options.machine.name",
                  [](auto& options) { options.mutable_machine()->set_name(std::string(101, 'x')); });
}

TEST_F(Refusals, NumbersThatTheEnumsDoNotKnow) {
  refused_options("options.strategy", [](auto& options) { options.set_strategy(static_cast<v1::CornerStrategy>(17)); });
  refused_options("options.tolerance_kind",
                  [](auto& options) { options.set_tolerance_kind(static_cast<v1::ToleranceKind>(-1)); });
}

TEST_F(Refusals, StrategyThatIsOnlyReported) {
  v1::PlanOptions bad = options();
  bad.set_strategy(v1::CORNER_STRATEGY_OVERLAPPING);
  const grpc::Status status = create({request(bad), request(right_angle())});
  EXPECT_TRUE(refuses_field(status, "options.strategy"));
  ASSERT_EQ(violations(status).size(), 1U);
  EXPECT_NE(violations(status)[0].find("ask for AUTO"), std::string::npos) << violations(status)[0];
}

TEST_F(Refusals, EverythingThatIsWrongAtOnce) {
  v1::PlanOptions bad = options();
  bad.mutable_machine()->set_jerk_mm_s3(0, -1);
  bad.mutable_machine()->set_velocity_mm_s(1, kNan);
  bad.set_tolerance_mm(-1);
  const grpc::Status status = create({request(bad)});
  EXPECT_EQ(violations(status).size(), 3U);
  EXPECT_TRUE(refuses_field(status, "options.machine.jerk_mm_s3[0]"));
  EXPECT_TRUE(refuses_field(status, "options.machine.velocity_mm_s[1]"));
  EXPECT_TRUE(refuses_field(status, "options.tolerance_mm"));
}

TEST_F(Refusals, MessagesOutOfOrder) {
  const auto path = request(right_angle());
  const auto program = gcode("G1 X1 F100\n");
  EXPECT_TRUE(refuses_field(create({}), "options"));
  EXPECT_TRUE(refuses_field(create({path}), "options"));
  EXPECT_TRUE(refuses_field(create({program, request(options())}), "options"));
  EXPECT_TRUE(refuses_field(create({request(options()), request(options()), path}), "options"));
  EXPECT_TRUE(refuses_field(create({request(options()), path, request(options())}), "options"));
  EXPECT_TRUE(refuses_field(create({request(options())}), "path"));
  EXPECT_TRUE(refuses_field(create({request(options()), path, program}), "gcode"));
  EXPECT_TRUE(refuses_field(create({request(options()), program, path}), "path"));
  EXPECT_TRUE(refuses_field(create({request(options()), v1::CreatePlanRequest()}), "content"));
}

TEST_F(Refusals, StartForAPathOfPoints) {
  v1::PlanOptions bad = options();
  bad.mutable_start_mm()->Resize(2, 0);
  EXPECT_TRUE(refuses_field(create({request(bad), request(right_angle())}), "options.start_mm"));
}

TEST_F(Refusals, PathsWithoutAMove) {
  EXPECT_TRUE(refuses_field(create({request(options()), request(v1::PathChunk())}), "path.points_mm"));
  EXPECT_TRUE(refuses_field(create({request(options()), request(path({1, 2}))}), "path.points_mm"));
}

TEST_F(Refusals, AbsurdPoints) {
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e308, -1e308, 1.1e7}) {
    refused_path("path.points_mm, start", [bad](auto& path) { path.set_points_mm(1, bad); });
    refused_path("path.points_mm, segment 1", [bad](auto& path) { path.set_points_mm(4, bad); });
    refused_path("path.feed_mm_s, segment 0", [bad](auto& path) { path.set_feed_mm_s(0, bad); });
    refused_path("path.tolerance_mm, segment 0", [bad](auto& path) { path.add_tolerance_mm(bad); });
  }
  refused_path("path.feed_mm_s, segment 2",
               [](auto& path) { path.mutable_feed_mm_s()->Add(100), path.add_feed_mm_s(100), path.add_feed_mm_s(0); });
}

TEST_F(Refusals, PlaceIsCountedInTheWholePath) {
  const auto first = request(path({0, 0, 10, 0, 10, 10}));
  const auto second = request(path({20, 10, 30, kNan}));
  EXPECT_TRUE(refuses_field(create({request(options()), first, second}), "path.points_mm, segment 3"));
}

TEST_F(Refusals, ArraysThatDoNotFitThePoints) {
  refused_path("path.points_mm", [](auto& path) { path.add_points_mm(1); });
  refused_path("path.feed_mm_s", [](auto& path) { path.add_feed_mm_s(1); });
  refused_path("path.feed_mm_s", [](auto& path) { path.clear_feed_mm_s(); });
  refused_path("path.tolerance_mm", [](auto& path) { path.mutable_tolerance_mm()->Resize(5, 0.1); });
  refused_path("path.line", [](auto& path) { path.add_line(1); });
  refused_path("path.line, segment 2", [](auto& path) {
    for (const std::uint32_t line : {1, 2, 3, 0}) path.add_line(line);
  });
}

TEST_F(Refusals, StopsThatAreNotThere) {
  refused_path("path.stops[0].point", [](auto& path) { path.add_stops()->set_point(4); });
  refused_path("path.stops[0].point", [](auto& path) { path.add_stops()->set_point(~0U); });
  refused_path("path.stops[1].point", [](auto& path) {
    path.add_stops()->set_point(1);
    path.add_stops()->set_point(1);
  });
  for (const double bad : {kNan, kInfinity, -1.0, 1e308}) {
    refused_path("path.stops[0].dwell_s", [bad](auto& path) { path.add_stops()->set_dwell_s(bad); });
  }
}

TEST_F(Refusals, ManyViolationsFitIntoTheAnswer) {
  std::vector<double> points(20'000, kNan);
  const grpc::Status status = create({request(options()), request(path(points))});
  EXPECT_TRUE(refuses_field(status, "path.points_mm, segment 3"));
  EXPECT_GT(violations(status).size(), 8U);
  EXPECT_LT(status.error_details().size(), 5000U);
}

TEST_F(Refusals, GcodeNamesLineAndColumn) {
  EXPECT_TRUE(refuses_field(create({request(options(3)), gcode("F100\n\n  G28\n")}), "gcode, line 3, column 3"));
}

TEST_F(Refusals, GarbageInsteadOfGcode) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    std::string garbage(1 + random() % 5000, '\0');
    for (char& byte : garbage) byte = static_cast<char>(random());
    const grpc::Status status = create({request(options(3)), gcode(garbage)});
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << status.error_message();
    EXPECT_FALSE(violations(status).empty());
  }
  EXPECT_EQ(create({request(options(3)), gcode("")}).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(create({request(options(3)), gcode("(nothing moves)\nM30\n")}).error_code(),
            grpc::StatusCode::INVALID_ARGUMENT);
}

TEST_F(Refusals, MessageThatIsNoCreatePlanRequest) {
  // The messages before it are a whole path: gRPC's own reader would take the broken one for the end of the upload.
  const auto bytes = [](const std::string& text) {
    const grpc::Slice slice(text);
    return grpc::ByteBuffer(&slice, 1);
  };
  const grpc::internal::RpcMethod method("/kcs.v1.PlanningService/CreatePlan",
                                         grpc::internal::RpcMethod::CLIENT_STREAMING);
  for (const std::string broken : {"garbage", "\xff\xff\xff\xff", "\x12\x7f"}) {
    Call call;
    v1::Plan plan;
    const auto channel = new_channel(server_.address());
    const std::unique_ptr<grpc::ClientWriter<grpc::ByteBuffer>> writer(
        grpc::internal::ClientWriterFactory<grpc::ByteBuffer>::Create(channel.get(), method, &call, &plan));
    writer->Write(bytes(request(options()).SerializeAsString()));
    writer->Write(bytes(request(right_angle()).SerializeAsString()));
    writer->Write(bytes(broken));
    writer->WritesDone();
    EXPECT_TRUE(refuses_field(writer->Finish(), "content"));
  }
}

TEST_F(Refusals, NamesThatAreMissing) {
  EXPECT_TRUE(refuses_field(server_.get("").status, "name"));
  EXPECT_TRUE(refuses_field(server_.remove(""), "name"));
  EXPECT_TRUE(refuses_field(server_.corners("").status, "name"));
  EXPECT_EQ(server_.get("plans/none").status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(server_.get(std::string(1'000'000, 'x')).status.error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST(StoredRefusals, DamagedOnesAreFailuresOfTheStore) {
  google::rpc::Status damaged;
  for (const int code : {-1, 0, 17, 124}) {
    damaged.set_code(code);
    EXPECT_EQ(decode_refusal(damaged.SerializeAsString()).error_code(), grpc::StatusCode::INTERNAL) << code;
  }
  EXPECT_EQ(decode_refusal("no message").error_code(), grpc::StatusCode::INTERNAL);
}

}  // namespace
}  // namespace kcs::service::test
