// ListPlans: pages, filters, and whose plans are listed.
#include <google/protobuf/util/time_util.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "tests/service/kept_plans.h"
#include "tests/service/secure_client.h"

namespace kcs::service::test {
namespace {

using google::protobuf::util::TimeUtil;

std::vector<std::string> names(const v1::ListPlansResponse& response) {
  std::vector<std::string> names;
  for (const v1::Plan& plan : response.plans()) names.push_back(plan.name());
  return names;
}

class ListPlans : public ::testing::Test {
 protected:
  // Of a plan that differs from all others.
  std::string create(const std::string& machine = "") {
    v1::PlanOptions named = options();
    named.mutable_machine()->set_name(machine);
    return create(named, request(path({0, 0, ++length_, 0})));
  }
  std::string create(const v1::PlanOptions& options, const v1::CreatePlanRequest& path) {
    const auto plan = server_.create({request(options), path});
    EXPECT_TRUE(plan.status.ok()) << plan.status.error_message();
    return plan.message.name();
  }

  std::vector<std::string> names_with(const v1::PlanFilter& filter) {
    v1::ListPlansRequest request;
    *request.mutable_filter() = filter;
    const auto answer = server_.list(request);
    EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
    return names(answer.message);
  }

  TestServer server_{{.planning_threads = 1}};
  double length_ = 10;
};

TEST_F(ListPlans, OfAnEmptyServerIsEmpty) {
  const auto answer = server_.list();
  EXPECT_TRUE(answer.status.ok());
  EXPECT_EQ(answer.message.plans_size(), 0);
  EXPECT_EQ(answer.message.next_page_token(), "");
}

TEST_F(ListPlans, SaysOfEachWhatGetPlanSaysButTheNotices) {
  const std::string name = create(options(), gcode("T1 M6\nG1 X10 F600\n"));
  v1::Plan plan = server_.get(name).message;
  ASSERT_GT(plan.notices_size(), 0);
  plan.clear_notices();
  const auto answer = server_.list();
  ASSERT_EQ(answer.message.plans_size(), 1);
  EXPECT_EQ(answer.message.plans(0).SerializeAsString(), plan.SerializeAsString());
}

TEST_F(ListPlans, GivesTheLatestFirstAndEachOnceWhateverComesAndGoesMeanwhile) {
  std::vector<std::string> all;
  for (int i = 0; i < 7; ++i) all.insert(all.begin(), create());
  v1::ListPlansRequest request;
  request.set_page_size(3);
  std::vector<std::string> listed;
  int pages = 0;
  do {
    const auto page = server_.list(request);
    ASSERT_TRUE(page.status.ok()) << page.status.error_message();
    EXPECT_LE(page.message.plans_size(), 3);
    for (const std::string& name : names(page.message)) listed.push_back(name);
    request.set_page_token(page.message.next_page_token());
    if (++pages == 1) {
      create();                                       // later than the first page
      EXPECT_TRUE(server_.remove(all.front()).ok());  // was on it
    }
  } while (!request.page_token().empty());
  EXPECT_EQ(listed, all);
  EXPECT_EQ(pages, 3);
}

TEST_F(ListPlans, LastPageThatIsJustFullHasNoTokenForAnother) {
  for (int i = 0; i < 4; ++i) create();
  v1::ListPlansRequest request;
  request.set_page_size(2);
  request.set_page_token(server_.list(request).message.next_page_token());
  const auto last = server_.list(request);
  EXPECT_EQ(last.message.plans_size(), 2);
  EXPECT_EQ(last.message.next_page_token(), "");
}

TEST_F(ListPlans, HasAHundredOnAPageUnlessAskedForMore) {
  for (int i = 0; i < 101; ++i) create();
  EXPECT_EQ(server_.list().message.plans_size(), 100);
  v1::ListPlansRequest request;
  request.set_page_size(1000);
  EXPECT_EQ(server_.list(request).message.plans_size(), 101);
}

TEST_F(ListPlans, FiltersByMachine) {
  const std::string nameless = create();
  const std::string router = create("Fräse \"1\"; %_'");
  create("lathe");
  v1::PlanFilter filter;
  filter.set_machine_name("Fräse \"1\"; %_'");
  EXPECT_EQ(names_with(filter), std::vector{router});
  filter.set_machine_name("");
  EXPECT_EQ(names_with(filter), std::vector{nameless});
  filter.set_machine_name("%");
  EXPECT_TRUE(names_with(filter).empty());
}

TEST_F(ListPlans, FiltersByState) {
  const std::string ready = create();
  const auto refused = server_.create({accept_only(too_fast_at_the_end()), request(path({0, 0, 1e-3, 0}))});
  ASSERT_TRUE(refused.status.ok()) << refused.status.error_message();
  ASSERT_TRUE(eventually([&] { return !server_.get(refused.message.name()).status.ok(); }));
  const auto endless = server_.create(join(accept_only(blended()), endless_path()));
  ASSERT_TRUE(endless.status.ok()) << endless.status.error_message();

  v1::PlanFilter filter;
  filter.set_state(v1::PLAN_STATE_READY);
  EXPECT_EQ(names_with(filter), std::vector{ready});
  filter.set_state(v1::PLAN_STATE_REFUSED);
  EXPECT_EQ(names_with(filter), std::vector{refused.message.name()});
  filter.set_state(v1::PLAN_STATE_WAITING);
  EXPECT_EQ(names_with(filter), std::vector{endless.message.name()});
  filter.set_state(v1::PLAN_STATE_PLANNING);
  EXPECT_EQ(names_with(filter), std::vector{endless.message.name()});

  const auto all = server_.list();
  ASSERT_EQ(all.message.plans_size(), 3);
  EXPECT_EQ(all.message.plans(1).state(), v1::PLAN_STATE_REFUSED);
  EXPECT_FALSE(all.message.plans(1).has_summary());
  EXPECT_TRUE(server_.remove(endless.message.name()).ok());
}

TEST_F(ListPlans, FiltersByTheTimeOfAcceptance) {
  std::vector<v1::Plan> plans;
  for (int i = 0; i < 3; ++i) plans.push_back(server_.get(create()).message);
  v1::PlanFilter filter;
  *filter.mutable_created_from() = plans[1].create_time();
  EXPECT_EQ(names_with(filter), (std::vector{plans[2].name(), plans[1].name()}));
  *filter.mutable_created_before() = plans[2].create_time();
  EXPECT_EQ(names_with(filter), std::vector{plans[1].name()});
  *filter.mutable_created_before() = plans[1].create_time();
  EXPECT_TRUE(names_with(filter).empty());
  *filter.mutable_created_before() = TimeUtil::SecondsToTimestamp(TimeUtil::kTimestampMaxSeconds);
  *filter.mutable_created_from() = TimeUtil::SecondsToTimestamp(TimeUtil::kTimestampMinSeconds);
  EXPECT_EQ(names_with(filter).size(), 3U);
}

TEST_F(ListPlans, FiltersByCycleTime) {
  std::vector<v1::Plan> plans;
  for (int i = 0; i < 3; ++i) plans.push_back(server_.get(create()).message);  // each takes longer
  v1::PlanFilter filter;
  filter.set_cycle_time_at_least_s(plans[1].summary().cycle_time_s());
  EXPECT_EQ(names_with(filter), (std::vector{plans[2].name(), plans[1].name()}));
  filter.set_cycle_time_at_most_s(plans[1].summary().cycle_time_s());
  EXPECT_EQ(names_with(filter), std::vector{plans[1].name()});
  filter.set_cycle_time_at_most_s(std::numeric_limits<double>::infinity());
  EXPECT_EQ(names_with(filter).size(), 2U);
}

TEST_F(ListPlans, RefusesWhatCannotBe) {
  const auto refused = [this](const auto& spoil) {
    v1::ListPlansRequest request;
    spoil(request);
    return server_.list(request).status;
  };
  using List = v1::ListPlansRequest;
  for (const int size : {-1, 1001, std::numeric_limits<int>::min()}) {
    EXPECT_TRUE(refuses_field(refused([size](List& list) { list.set_page_size(size); }), "page_size"));
  }
  EXPECT_TRUE(refuses_field(
      refused([](List& list) { list.mutable_filter()->set_state(static_cast<v1::PlanState>(9)); }), "filter.state"));
  EXPECT_TRUE(refuses_field(refused([](List& list) { list.mutable_filter()->mutable_created_from()->set_nanos(-1); }),
                            "filter.created_from"));
  EXPECT_TRUE(refuses_field(refused([](List& list) {
                              list.mutable_filter()->mutable_created_before()->set_seconds(
                                  std::numeric_limits<std::int64_t>::max());
                            }),
                            "filter.created_before"));
  for (const double seconds : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(
        refuses_field(refused([seconds](List& list) { list.mutable_filter()->set_cycle_time_at_least_s(seconds); }),
                      "filter.cycle_time_at_least_s"));
    EXPECT_TRUE(
        refuses_field(refused([seconds](List& list) { list.mutable_filter()->set_cycle_time_at_most_s(seconds); }),
                      "filter.cycle_time_at_most_s"));
  }
}

TEST_F(ListPlans, RefusesTokensThatItDidNotGiveForThisList) {
  create();
  create();
  v1::ListPlansRequest request;
  request.set_page_size(1);
  const std::string token = server_.list(request).message.next_page_token();
  ASSERT_NE(token, "");
  for (const std::string& bad : {std::string("x"), token.substr(1), token + token, std::string(100'000, '/')}) {
    request.set_page_token(bad);
    EXPECT_TRUE(refuses_field(server_.list(request).status, "page_token")) << bad.substr(0, 100);
  }
  request.set_page_token(token);
  request.mutable_filter()->set_machine_name("another");
  EXPECT_TRUE(refuses_field(server_.list(request).status, "page_token"));
  request.clear_filter();
  request.set_page_size(2);  // may change from page to page
  EXPECT_EQ(server_.list(request).message.plans_size(), 1);
}

class ListOfOwners : public ::testing::Test {
 protected:
  static std::string create(SecureClient& client, double length) {
    const auto plan = client.create({request(options()), request(path({0, 0, length, 0}))});
    EXPECT_TRUE(plan.status.ok()) << plan.status.error_message();
    return plan.message.name();
  }

  TestServer server_{with_tokens({known("cam", {security::Role::kPlan}), known("shop", {security::Role::kPlan}),
                                  known("admin", {security::Role::kAdmin})})};
  SecureClient cam_ = client_of(server_, "cam");
  SecureClient shop_ = client_of(server_, "shop");
  SecureClient admin_ = client_of(server_, "admin");
};

TEST_F(ListOfOwners, HasOnesOwnPlansAndOfAnAdministratorEverybodys) {
  const std::string cams = create(cam_, 10);
  const std::string both = create(cam_, 20);
  const std::string shops = create(shop_, 30);
  EXPECT_EQ(create(shop_, 20), both);
  EXPECT_EQ(names(cam_.list().message), (std::vector{both, cams}));
  EXPECT_EQ(names(shop_.list().message), (std::vector{both, shops}));
  EXPECT_EQ(names(admin_.list().message), (std::vector{shops, both, cams})) << "each once, when it came first";
  EXPECT_EQ(shop_.list().message.plans(0).summary().path_length_mm(), 20);
}

TEST_F(ListOfOwners, DoesNotTakeAnotherOnesToken) {
  for (const double length : {10, 20}) {
    create(cam_, length);
    create(shop_, length + 1);
  }
  v1::ListPlansRequest request;
  request.set_page_size(1);
  request.set_page_token(cam_.list(request).message.next_page_token());
  EXPECT_TRUE(refuses_field(shop_.list(request).status, "page_token"));
  EXPECT_EQ(cam_.list(request).message.plans_size(), 1);
}

}  // namespace
}  // namespace kcs::service::test
