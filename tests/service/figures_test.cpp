// What a server says of itself over HTTP moves with what it does.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <map>
#include <string>
#include <thread>

#include "server/net/address.h"
#include "server/version/version.h"
#include "tests/observe/figures.h"
#include "tests/service/kept_plans.h"
#include "tests/service/live_client.h"
#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

class Figures : public ::testing::Test {
 protected:
  httplib::Result get(const std::string& path) {
    const auto address = net::parse_host_port(server_.server().http_address()).value();
    httplib::Client client(address.host, address.port);
    client.set_read_timeout(kDeadline);
    return client.Get(path);
  }

  // The value of a series; 0 if there is none yet.
  double figure(const std::string& series) {
    const auto samples = observe::test::read_figures(server_.server().http_address());
    const auto found = samples.find(series);
    return found == samples.end() ? 0 : found->second;
  }

  std::string make_plan() {
    const auto plan = server_.create({request(options()), request(right_angle())});
    EXPECT_TRUE(plan.status.ok()) << plan.status.error_message();
    return plan.message.name();
  }

  TestServer server_{{.planning_threads = 1,
                      .caps = {.points_per_plan = 40'000, .cached_plans = 1, .uploads = 2},
                      .observe = {.http_listen = "127.0.0.1:0"}}};
};

TEST_F(Figures, CountPlansAndTheirSegments) {
  make_plan();
  make_plan();  // the same request: not planned again
  EXPECT_EQ(figure("kcs_planning_duration_seconds_count"), 1);
  EXPECT_GT(figure("kcs_planning_duration_seconds_sum"), 0);
  EXPECT_EQ(figure("kcs_segments_planned_total"), 2);
  EXPECT_EQ(figure("kcs_rpcs_total{method=\"CreatePlan\",code=\"OK\"}"), 2);
  EXPECT_EQ(figure("kcs_rpc_duration_seconds_count{method=\"CreatePlan\"}"), 2);
}

TEST_F(Figures, CountRefusalsByTheirReason) {
  EXPECT_FALSE(server_.create({request(options()), request(path({0, 0, 10, 0}, -1))}).status.ok());
  EXPECT_EQ(figure("kcs_rejections_total{reason=\"invalid_argument\"}"), 1);
  EXPECT_FALSE(server_.get("plans/none").status.ok());
  EXPECT_EQ(figure("kcs_rejections_total{reason=\"not_found\"}"), 1);
  EXPECT_FALSE(server_.create({request(options()), request(path(std::vector<double>(80'002)))}).status.ok());
  EXPECT_EQ(figure("kcs_rejections_total{reason=\"points_per_plan\"}"), 1);
  EXPECT_EQ(figure("kcs_rpcs_total{method=\"CreatePlan\",code=\"RESOURCE_EXHAUSTED\"}"), 1);
  EXPECT_EQ(figure("kcs_planning_duration_seconds_count"), 0);
}

TEST_F(Figures, TellThatAPlanMemoryHasLostIsMadeOnceForAllWhoWantIt) {
  const std::string name = server_.create({request(options()), request(long_path())}).message.name();
  make_plan();
  {
    std::vector<std::jthread> streams;
    for (int i = 0; i < 20; ++i) {
      streams.emplace_back([&] { EXPECT_TRUE(server_.stream(setpoints(name, 1)).status.ok()); });
    }
  }
  EXPECT_EQ(figure("kcs_planning_duration_seconds_count"), 3);
  EXPECT_EQ(figure("kcs_store_duration_seconds_count{operation=\"request\"}"), 1);
}

TEST_F(Figures, CountSetpointsAsTheyAreSent) {
  const auto sent = server_.stream(setpoints(make_plan(), 1e-3));
  ASSERT_TRUE(sent.status.ok());
  EXPECT_EQ(figure("kcs_setpoints_sent_total"), static_cast<double>(column(sent.message, 0).size()));
}

TEST_F(Figures, CountWhatIsPlannedLive) {
  const LiveAnswer answer =
      LiveClient(server_).exchange(live({request(options()), request(right_angle())}, every(1e-3)));
  ASSERT_TRUE(answer.status.ok());
  EXPECT_EQ(figure("kcs_segments_planned_total"), 2);
  EXPECT_EQ(figure("kcs_setpoints_sent_total"), static_cast<double>(column(answer.setpoints, 0).size()));
}

TEST_F(Figures, CountTheStreamsThatAreOpen) {
  v1::PlanOptions slow = options();
  slow.set_feed_mm_s(0.1);
  const auto plan = server_.create({request(slow), request(right_angle())});
  ASSERT_TRUE(plan.status.ok());
  Call call;
  const auto reader = server_.stub().StreamSetpoints(&call, setpoints(plan.message.name(), 1e-5));
  v1::SetpointBatch batch;
  ASSERT_TRUE(reader->Read(&batch));
  EXPECT_EQ(figure("kcs_rpcs_running{method=\"StreamSetpoints\"}"), 1);
  call.TryCancel();
  while (reader->Read(&batch)) continue;
  reader->Finish();
  EXPECT_TRUE(eventually([this] { return figure("kcs_rpcs_running{method=\"StreamSetpoints\"}") == 0; }));
  EXPECT_EQ(figure("kcs_rpcs_total{method=\"StreamSetpoints\",code=\"CANCELLED\"}"), 1);
  EXPECT_EQ(figure("kcs_rejections_total{reason=\"cancelled\"}"), 0) << "a client that gives up is not refused";
}

TEST_F(Figures, AreThoseOfThisServerAlone) {
  TestServer other{{.observe = {.http_listen = "127.0.0.1:0"}}};
  other.create({request(options()), request(right_angle())});
  EXPECT_EQ(figure("kcs_planning_duration_seconds_count"), 0);
  EXPECT_EQ(figure(fmt::format("kcs_build_info{{version=\"{}\",build=\"{}\"}}", version(), build())), 1);
  EXPECT_EQ(figure("kcs_planning_queue_depth"), 0);
  EXPECT_EQ(figure("kcs_plans_running"), 0);
}

TEST_F(Figures, TellThatAStoppingServerTakesNoMoreRequests) {
  EXPECT_EQ(get("/readyz")->status, 200);
  Call call;
  v1::Plan plan;
  const auto upload = server_.stub().CreatePlan(&call, &plan);
  upload->Write(request(options()));
  ASSERT_TRUE(eventually([this] { return figure("kcs_rpcs_running{method=\"CreatePlan\"}") == 1; }));
  std::thread stopping([this] { server_.server().stop(kDeadline); });
  EXPECT_TRUE(eventually([this] { return get("/readyz")->status == 503; }));
  EXPECT_EQ(get("/readyz")->body, "not ready: the server is stopping\n");
  EXPECT_EQ(get("/healthz")->status, 200);
  EXPECT_EQ(server_.get("plans/none").status.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(figure("kcs_rejections_total{reason=\"unavailable\"}"), 1);
  upload->Write(request(right_angle()));
  upload->WritesDone();
  EXPECT_TRUE(upload->Finish().ok());
  stopping.join();
}

TEST(Http, PortInUseKeepsTheServerFromStarting) {
  TestServer first{{.observe = {.http_listen = "127.0.0.1:0"}}};
  const std::string taken = first.server().http_address();
  try {
    const Server second({.listen = "", .observe = {.http_listen = taken}});
    ADD_FAILURE() << "serves HTTP on a port that is in use";
  } catch (const std::runtime_error& refused) {
    EXPECT_NE(std::string(refused.what()).find("cannot serve HTTP on " + taken), std::string::npos) << refused.what();
  }
}

TEST(Http, IsOffUnlessAskedFor) {
  TestServer server;
  EXPECT_EQ(server.server().http_address(), "");
}

}  // namespace
}  // namespace kcs::service::test
