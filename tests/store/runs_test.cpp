// The runs of machines: which one is open, what is known of it, and the plan it needs.
#include <gmock/gmock.h>

#include <thread>

#include "tests/store/store_test.h"

namespace kcs::store {
namespace {

using ::testing::HasSubstr;

class Runs : public StoreTest {
 protected:
  static void end(Store& store, RunRecord run) {
    run.state = RunRecordState::kFinished;
    store.update_run(run);
  }
};
KCS_ON_EACH_DATABASE(Runs);

TEST_P(Runs, AreThereWhenTheStoreIsOpenedAgain) {
  const auto before = std::chrono::system_clock::now() - std::chrono::seconds(2);
  RunRecord run = run_of(1);
  run.feed_override = 0.1;
  RunRecord added;
  {
    Store store(settings_);
    accept_finished(store, "ada", 1);
    added = store.add_run(run);
  }
  EXPECT_EQ(added.name, "machines/mill/runs/1");
  EXPECT_GT(added.create_time, before);
  EXPECT_LT(added.create_time, std::chrono::system_clock::now() + std::chrono::seconds(2));
  run.name = added.name;
  run.create_time = added.create_time;
  EXPECT_EQ(added, run);
  Store store(settings_);
  EXPECT_EQ(store.find_run(added.name), added);
  EXPECT_EQ(store.open_run("machines/mill"), added);
}

TEST_P(Runs, KeepHowTheyGo) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  RunRecord run = store.add_run(run_of(1));
  run.controller = "Bär 'B'";
  run.held = true;
  run.feed_override = 1.0 / 3;
  run.plan_time = 12345.678901234567;
  run.reason = "the gateway's connection was lost";
  store.update_run(run);
  EXPECT_EQ(store.find_run(run.name), run);
  EXPECT_EQ(store.open_run("machines/mill"), run);
  run.held = false;
  run.reason.clear();
  store.update_run(run);
  EXPECT_EQ(store.open_run("machines/mill"), run);
}

TEST_P(Runs, ThatAreOverStayAsTheyAre) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  for (const RunRecordState state : {RunRecordState::kFinished, RunRecordState::kAborted, RunRecordState::kFailed}) {
    RunRecord over = store.add_run(run_of(1));
    over.state = state;
    store.update_run(over);
    RunRecord late = over;
    late.state = RunRecordState::kOpen;
    late.plan_time = 5;
    store.update_run(late);
    EXPECT_EQ(store.find_run(over.name), over);
    EXPECT_FALSE(store.open_run("machines/mill"));
  }
}

TEST_P(Runs, AMachineHasOneThatIsOpen) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  accept_finished(store, "ada", 2);
  const RunRecord first = store.add_run(run_of(1));
  for (const std::uint64_t plan : {1, 2}) {
    try {
      store.add_run(run_of(plan));
      FAIL() << "the machine has two runs";
    } catch (const MachineHasRun& refused) {
      EXPECT_THAT(refused.what(), HasSubstr(first.name));
    }
  }
  EXPECT_EQ(store.add_run(run_of(1, "machines/lathe")).name, "machines/lathe/runs/1");
  EXPECT_EQ(store.open_run("machines/mill"), first);
  end(store, first);
  EXPECT_EQ(store.add_run(run_of(2)).name, "machines/mill/runs/2");
}

TEST_P(Runs, AreOfPlansThatAreKept) {
  Store store(settings_);
  EXPECT_THROW(store.add_run(run_of(1)), PlanNotKept);
  accept_finished(store, "ada", 1);
  store.remove("ada", plan_name(1));
  EXPECT_THROW(store.add_run(run_of(1)), PlanNotKept);
  EXPECT_FALSE(store.open_run("machines/mill"));
  for (const char* table : {"runs", "owners"}) {
    EXPECT_EQ(query(settings_, std::string("select count(*) from ") + table), "0") << table;
  }
  accept_finished(store, "ada", 1);
  EXPECT_EQ(store.add_run(run_of(1)).name, "machines/mill/runs/1");
}

TEST_P(Runs, ThatNobodyBeganAreNotFound) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  const RunRecord run = store.add_run(run_of(1));
  for (const std::string& name : {std::string(), run.name + " ", run.name + '\0', run.name + '\0' + "x",
                                  std::string("machines/mill/runs/2"), std::string("' or ''='")}) {
    EXPECT_FALSE(store.find_run(name)) << name;
  }
  for (const std::string& machine : {std::string(), run.machine + '\0', std::string("machines/Mill")}) {
    EXPECT_FALSE(store.open_run(machine)) << machine;
  }
  RunRecord unknown = run;
  unknown.name = "machines/mill/runs/2";
  end(store, unknown);
  EXPECT_FALSE(store.find_run(unknown.name));
  EXPECT_EQ(store.open_run("machines/mill"), run);
}

TEST_P(Runs, KeepAPlanThatItsOwnerRemoves) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  const RunRecord run = store.add_run(run_of(1));
  EXPECT_EQ(store.remove("ada", plan_name(1)), Removal::kOthersKeepIt);
  EXPECT_FALSE(store.find("ada", plan_name(1)));
  EXPECT_EQ(store.request(plan_name(1)), "request");
  EXPECT_EQ(store.find(run.name, plan_name(1))->outcome, "plan");
  end(store, run);
  EXPECT_FALSE(store.request(plan_name(1)));
  for (const char* table : {"plans", "owners", "request_rows"}) {
    EXPECT_EQ(query(settings_, std::string("select count(*) from ") + table), "0") << table;
  }
}

TEST_P(Runs, KeepAPlanThatIsRemovedForEverybody) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  accept_finished(store, "bob", 1);
  const RunRecord first = store.add_run(run_of(1));
  const RunRecord second = store.add_run(run_of(1, "machines/lathe"));
  EXPECT_EQ(store.remove(std::nullopt, plan_name(1)), Removal::kOthersKeepIt);
  EXPECT_FALSE(store.find("ada", plan_name(1)));
  EXPECT_FALSE(store.find("bob", plan_name(1)));
  end(store, first);
  EXPECT_FALSE(store.find(first.name, plan_name(1)));
  EXPECT_TRUE(store.find(second.name, plan_name(1)));
  end(store, second);
  EXPECT_FALSE(store.request(plan_name(1)));
}

TEST_P(Runs, LeaveAPlanToItsOwnersAtTheirEnd) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  const RunRecord run = store.add_run(run_of(1));
  store.remove("ada", plan_name(1));
  EXPECT_EQ(accept(store, "bob", 1).outcome, "plan");
  end(store, run);
  EXPECT_TRUE(store.find("bob", plan_name(1)));
  EXPECT_FALSE(store.find(run.name, plan_name(1)));
}

TEST_P(Runs, KeepTheirPlanFromBeingForgotten) {
  settings_.keep = std::chrono::seconds(1);
  settings_.keep_bytes = 1;
  Store store(settings_);
  accept_finished(store, "ada", 1);
  accept_finished(store, "ada", 2);
  const RunRecord run = store.add_run(run_of(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  EXPECT_EQ(store.sweep(), std::vector{plan_name(2)});
  EXPECT_EQ(store.open_run("machines/mill"), run);
  EXPECT_EQ(store.request(plan_name(1)), "request");
  end(store, run);
  EXPECT_EQ(store.sweep(), std::vector{plan_name(1)});
}

TEST_P(Runs, AreForgottenSomeTimeAfterTheirEnd) {
  settings_.keep = std::chrono::seconds(3);
  Store store(settings_);
  accept_finished(store, "ada", 1);
  const RunRecord old = store.add_run(run_of(1));
  end(store, old);
  const RunRecord open = store.add_run(run_of(1, "machines/lathe"));
  const RunRecord late = store.add_run(run_of(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(3100));
  end(store, late);
  store.sweep();
  EXPECT_FALSE(store.find_run(old.name));
  EXPECT_TRUE(store.find_run(late.name));
  EXPECT_TRUE(store.find_run(open.name));
}

TEST_P(Runs, NumbersAreNeverGivenAgain) {
  settings_.keep = std::chrono::seconds(0);
  for (const char* name : {"machines/mill/runs/1", "machines/mill/runs/2", "machines/mill/runs/3"}) {
    Store store(settings_);
    accept_finished(store, "ada", 1);
    const RunRecord run = store.add_run(run_of(1));
    EXPECT_EQ(run.name, name);
    end(store, run);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    store.sweep();
    EXPECT_EQ(query(settings_, "select count(*) from runs"), "0");
  }
}

}  // namespace
}  // namespace kcs::store
