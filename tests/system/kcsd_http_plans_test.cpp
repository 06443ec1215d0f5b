// Plans over HTTP, as curl asks for them, and clients that mean no good.
#include <gtest/gtest.h>
#include <httplib.h>

#include <deque>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/system/raw_connection.h"
#include "tests/system/test_kcsd.h"

namespace kcs::test {
namespace {

using nlohmann::json;

constexpr const char* kCurlsType = "application/x-www-form-urlencoded";  // of --data-binary
constexpr const char* kZigzag = "G21 G90 F6000\nG1 X20 Y0\nX3 Y10\nX22 Y16\nM2\n";
constexpr const char* kRouter = "/v1/plans?machine=router&tolerance=0.02";
const std::string kInMemory = "[store]\ndatabase = \"memory\"\n";

class HttpPlans : public ::testing::Test {
 protected:
  explicit HttpPlans(const std::string& settings = "")
      : kcsd_(kInMemory + settings), client_("http://" + kcsd_.http_address()) {
    client_.set_read_timeout(kDeadline);
  }

  httplib::Result post(const std::string& target, const std::string& program, const httplib::Headers& headers = {}) {
    return client_.Post(target, headers, program, kCurlsType);
  }

  // The beginning of a request whose body has so many bytes, the first of which come with it.
  static std::string beginning(std::size_t size, const std::string& body = "") {
    return std::string("POST ") + kRouter + " HTTP/1.1\r\nHost: x\r\nContent-Length: " + std::to_string(size) +
           "\r\n\r\n" + body;
  }

  // Whether the figures come to say so.
  bool comes_to_show(const std::string& figure) {
    return eventually([&] { return kcsd_.page("/metrics").text.find(figure) != std::string::npos; });
  }

  TestKcsd kcsd_;
  httplib::Client client_;
};

TEST_F(HttpPlans, GivesTheSummaryOfAProgram) {
  const auto answer = post(kRouter, kZigzag, {{"X-Request-Id", "job-7"}});
  ASSERT_TRUE(answer);
  ASSERT_EQ(answer->status, 200) << answer->body;
  EXPECT_EQ(answer->get_header_value("Content-Type"), "application/json");
  EXPECT_EQ(answer->get_header_value("X-Request-Id"), "job-7");
  const json plan = json::parse(answer->body);
  EXPECT_GT(plan["cycle_time_s"], 0.5);
  EXPECT_EQ(plan["verified"], true);
  EXPECT_EQ(plan["corner_count"], 2);
  EXPECT_EQ(plan["machine"], "CNC router");
  EXPECT_EQ(plan["tolerance_mm"], 0.02);
  EXPECT_LE(plan["max_contour_error_mm"], 0.02);
  ASSERT_FALSE(plan["slow_spots"].empty());
  EXPECT_GT(plan["slow_spots"][0]["time_lost_s"], 0);
  EXPECT_EQ(plan["slow_spots"][0]["line"], 3);

  const auto again = client_.Get("/v1/" + plan["name"].get<std::string>());
  ASSERT_TRUE(again);
  EXPECT_EQ(json::parse(again->body), plan);
}

TEST_F(HttpPlans, TakesTheLimitsOfAnyMachine) {
  const auto answer =
      post("/v1/plans?velocity=200,200,100&acceleration=1000,1000,600&jerk=20000,20000,12000&feed=50", kZigzag);
  ASSERT_TRUE(answer);
  ASSERT_EQ(answer->status, 200) << answer->body;
  EXPECT_NEAR(json::parse(answer->body)["max_feed_mm_s"], 50, 0.01);
}

TEST_F(HttpPlans, SayWhichLineCannotBePlanned) {
  const auto answer = post(kRouter, "G1 X20 F6000\nG1 X20 Y\n");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 400);
  const json error = json::parse(answer->body)["error"];
  EXPECT_EQ(error["code"], "INVALID_ARGUMENT");
  ASSERT_EQ(error["violations"].size(), 1) << answer->body;
  EXPECT_EQ(error["violations"][0]["line"], 2);
}

TEST_F(HttpPlans, SayWhatIsWrongWithTheQuery) {
  for (const auto& [query, reason] : {std::pair{"?machine=lathe", "router"},
                                      {"", "name a machine"},
                                      {"?machine=router&tolerance=fine", "is no number"},
                                      {"?machine=router&tolerance=-1", "tolerance_mm"},
                                      {"?machine=router&colour=red", "unknown"},
                                      {"?velocity=1,2&acceleration=3&jerk=4,5", "acceleration_mm_s2"},
                                      {"?machine=router&machine=lathe", "twice"}}) {
    const auto answer = post(std::string("/v1/plans") + query, kZigzag);
    ASSERT_TRUE(answer) << query;
    EXPECT_EQ(answer->status, 400) << query;
    EXPECT_NE(answer->body.find(reason), std::string::npos) << query << answer->body;
  }
}

TEST_F(HttpPlans, RefuseWhatIsNoProgram) {
  const auto nothing = post(kRouter, "");
  ASSERT_TRUE(nothing);
  EXPECT_EQ(nothing->status, 400) << nothing->body;
  const auto form = client_.Post(kRouter, httplib::MultipartFormDataItems{{"file", kZigzag, "part.nc", "text/plain"}});
  ASSERT_TRUE(form);
  EXPECT_EQ(form->status, 415);
  EXPECT_NE(form->body.find("--data-binary"), std::string::npos);
  EXPECT_EQ(client_.Get("/v1/plans/0123")->status, 404);
}

class SmallHttpPlans : public HttpPlans {
 protected:
  SmallHttpPlans() : HttpPlans("[caps]\ngcode_bytes = 100_000\nhttp_plans = 1\n") {}
};

TEST_F(SmallHttpPlans, RefuseAProgramBeyondTheCapWithoutKeepingIt) {
  const std::size_t before = kcsd_.status_figure("VmHWM:");
  constexpr std::size_t kBytes = 100'000'000;
  const std::string piece = [] {
    std::string lines;
    for (int i = 0; i < 1000; ++i) lines += "(nothing at all)\n";
    return lines;
  }();
  std::size_t sent = 0;
  const auto answer = client_.Post(
      kRouter, {},
      [&](std::size_t, httplib::DataSink& sink) {
        if (sent >= kBytes) return sink.done(), true;
        sent += piece.size();
        return sink.write(piece.data(), piece.size());
      },
      kCurlsType);
  if (answer) {  // a client that goes on sending may miss it
    EXPECT_EQ(answer->status, 413) << answer->body;
    EXPECT_NE(answer->body.find("gcode_bytes"), std::string::npos) << answer->body;
  }
  EXPECT_LT(kcsd_.status_figure("VmHWM:"), before + 30'000);
  EXPECT_TRUE(comes_to_show("kcs_rejections_total{reason=\"gcode_bytes\"} 1"));
}

TEST_F(SmallHttpPlans, OneTooManyIsToldToComeAgain) {
  RawConnection busy(kcsd_.http_address());
  busy.send(beginning(100'000, "G1 "));
  ASSERT_TRUE(comes_to_show("kcs_rpcs_running{method=\"CreatePlan\"} 1"));
  const auto second = post(kRouter, kZigzag);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->status, 503);
  EXPECT_EQ(second->get_header_value("Retry-After"), "1");
  EXPECT_NE(second->body.find("http_plans"), std::string::npos);
}

TEST_F(HttpPlans, ThatComeByteByByteAreEndedAndHoldUpNobody) {
  std::deque<RawConnection> slow;
  for (int i = 0; i < 8; ++i) slow.emplace_back(kcsd_.http_address()).send(beginning(100'000, "G"));
  ASSERT_TRUE(comes_to_show("kcs_rpcs_running{method=\"CreatePlan\"} 8"));
  EXPECT_EQ(kcsd_.page("/healthz").status, 200);
  EXPECT_TRUE(eventually([&] {
    for (RawConnection& connection : slow) connection.send("1");
    return slow.front().is_closed_within(std::chrono::milliseconds(100));
  }));
  EXPECT_TRUE(comes_to_show("kcs_rpcs_running{method=\"CreatePlan\"} 0"));
  EXPECT_EQ(post(kRouter, kZigzag)->status, 200);
}

TEST_F(HttpPlans, ThatBreakOffAreNotPlanned) {
  {
    RawConnection connection(kcsd_.http_address());
    connection.send(beginning(100'000, kZigzag));
    ASSERT_TRUE(comes_to_show("kcs_rpcs_running{method=\"CreatePlan\"} 1"));
  }
  EXPECT_TRUE(comes_to_show("kcs_rpcs_total{method=\"CreatePlan\",code=\"CANCELLED\"} 1"));
  EXPECT_EQ(kcsd_.page("/metrics").text.find("method=\"CreatePlan\",code=\"OK\""), std::string::npos);
}

TEST_F(HttpPlans, ArePlannedNoLongerThanTheirClientWaits) {
  std::string program = "G21 G90 G1 F6000\n";
  for (int i = 0; i < 900'000; ++i) program += i % 2 == 0 ? "X1 Y1\n" : "X0 Y2\n";  // minutes of planning
  {
    RawConnection connection(kcsd_.http_address());
    ASSERT_TRUE(connection.send_all(beginning(program.size(), program)));
    ASSERT_TRUE(comes_to_show("kcs_plans_running 1"));
  }
  EXPECT_TRUE(comes_to_show("kcs_rpcs_total{method=\"CreatePlan\",code=\"CANCELLED\"} 1"));
  EXPECT_TRUE(comes_to_show("kcs_plans_running 0"));
}

class SecretHttpPlans : public HttpPlans {
 protected:
  // The hashes of "for-plans" and "for-streams".
  SecretHttpPlans()
      : HttpPlans(
            "[[tokens]]\nhash = \"sha256:63a43f0a7d71c4b6b72e376421bfe5c4799e6e6cefbe22e7ad8d22b97fa4347a\"\nowner = "
            "\"cam\"\nroles = [\"plan\"]\n"
            "[[tokens]]\nhash = \"sha256:4ba95edda936a708cb234ab3685f9b5509e5e0b582051c48bd030531f1434ee4\"\nowner = "
            "\"gateway\"\nroles = [\"stream\"]\n") {}
};

TEST_F(SecretHttpPlans, AreMadeForWhoHasATokenWithTheRole) {
  const auto nobody = post(kRouter, kZigzag);
  ASSERT_TRUE(nobody);
  EXPECT_EQ(nobody->status, 401);
  EXPECT_EQ(nobody->get_header_value("WWW-Authenticate"), "Bearer");
  EXPECT_EQ(post(kRouter, kZigzag, {{"Authorization", "Bearer wrong"}})->status, 401);
  EXPECT_EQ(post(kRouter, kZigzag, {{"Authorization", "Bearer \x80\x81"}})->status, 400);
  EXPECT_EQ(post(kRouter, kZigzag, {{"Authorization", "Bearer for-streams"}})->status, 403);
  const auto planned = post(kRouter, kZigzag, {{"Authorization", "Bearer for-plans"}});
  ASSERT_TRUE(planned);
  ASSERT_EQ(planned->status, 200) << planned->body;
  const std::string name = json::parse(planned->body)["name"];
  EXPECT_EQ(client_.Get("/v1/" + name)->status, 401);
  EXPECT_EQ(client_.Get("/v1/" + name, {{"Authorization", "Bearer for-plans"}})->status, 200);
}

}  // namespace
}  // namespace kcs::test
