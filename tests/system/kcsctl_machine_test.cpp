// kcsctl's commands for machines, with a real kcsd and a real gateway with simulated drives.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/files/temporary_folder.h"
#include "tests/rpc/eventually.h"
#include "tests/system/child_process.h"
#include "tests/system/kcsd_process.h"
#include "tests/system/terminal_process.h"

namespace kcs::test {
namespace {

using nlohmann::json;

constexpr char kCtrlC = '\x03';

class KcsctlMachine : public testing::Test {
 protected:
  KcsctlMachine() {
    folder_.write("short.ngc", "G1 X10 Y0 F6000\nX10 Y10\n");
    folder_.write("long.ngc", "G1 X100 F60\nY100\n");  // more than three minutes
    EXPECT_TRUE(eventually([this] { return !machine().is_null(); })) << gateway_.errors();
  }

  std::string path(const std::string& name) const { return folder_.path(name); }

  std::vector<std::string> command(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), KCSCTL);
    arguments.insert(arguments.end(), {"--server", kcsd_.address()});
    return arguments;
  }
  Result run(std::vector<std::string> arguments) const { return kcs::test::run(command(std::move(arguments))); }

  // Null if it is not attached.
  json machine() const {
    const std::string output = run({"machines", "--json"}).output;
    return output.empty() ? json() : json::parse(output);
  }
  bool becomes(const std::string& state) const {
    return eventually([&] { return machine()["state"] == state; });
  }
  void begin_long_run() const {
    const Result begun = run({"run", path("long.ngc"), "--on", "machines/mill"});
    ASSERT_EQ(begun.exit_code, 0) << begun.errors;
    ASSERT_TRUE(becomes("running"));
  }

  const TemporaryFolder folder_;
  const KcsdProcess kcsd_{{KCSD, "--database", "memory", "--listen", "127.0.0.1:0"}};
  const ChildProcess gateway_{
      {KCS_GATEWAY, "attach", "--server", kcsd_.address(), "--config",
       folder_.write("gateway.toml", "[machine]\nname = \"mill\"\n[simulated]\nstart_mm = [1.5, 2.5, 0.1]\n")}};
};

TEST_F(KcsctlMachine, RunsAProgramFromWhereTheMachineStandsWithItsOwnLimits) {
  const Result table = run({"machines"});
  EXPECT_NE(table.output.find("machines/mill         ready               1.500      2.500      0.100  -"),
            std::string::npos)
      << table.output;
  const Result watched = run({"run", path("short.ngc"), "--on", "mill", "--watch", "--json", "--override", "120"});
  ASSERT_EQ(watched.exit_code, 0) << watched.errors;
  std::istringstream lines(watched.output);
  json last;
  for (std::string line; std::getline(lines, line);) last = json::parse(line);
  EXPECT_EQ(last["state"], "finished");
  EXPECT_EQ(last["feed_override_percent"], 120);
  EXPECT_EQ(last["plan_time_s"], last["cycle_time_s"]);
  EXPECT_EQ(machine()["position_mm"], (json{10, 10, 0.1}));
  EXPECT_EQ(run({"watch", last["name"]}).exit_code, 0) << "it is over, and well";
}

TEST_F(KcsctlMachine, RunsAPlanThatTheServerKeeps) {
  const json plan =
      json::parse(run({"plan", "--json", path("short.ngc"), "--start", "1.5,2.5,0.1", "--machine", "router"}).output);
  const Result begun = run({"run", "--plan", plan["name"], "--on", "mill", "--json"});
  ASSERT_EQ(begun.exit_code, 0) << begun.errors;
  EXPECT_EQ(json::parse(begun.output)["plan"], plan["name"]);
  EXPECT_TRUE(eventually([this] { return machine()["position_mm"] == json{10, 10, 0.1}; })) << machine();
}

TEST_F(KcsctlMachine, HoldsResumesChangesThePaceAndAborts) {
  begin_long_run();
  EXPECT_EQ(run({"hold", "mill"}).exit_code, 0);
  EXPECT_TRUE(becomes("held")) << machine();
  EXPECT_EQ(run({"resume", "machines/mill"}).exit_code, 0);
  EXPECT_TRUE(becomes("running")) << machine();
  const std::string name = machine()["run"];
  EXPECT_NE(run({"override", name, "35"}).output.find("override 35 %"), std::string::npos);
  ChildProcess watch(command({"watch", name}));
  EXPECT_EQ(watch.read_line().rfind(name + "  running", 0), 0);
  EXPECT_EQ(run({"abort", "mill"}).exit_code, 0);
  std::string line, last;
  while (!(line = watch.read_line()).empty()) last = line;
  EXPECT_EQ(last.rfind(name + "  aborted", 0), 0) << last;
  EXPECT_EQ(watch.wait(), 1) << "a script must know that it did not finish";
  EXPECT_EQ(watch.errors(), "kcsctl: " + name + " was aborted\n");
}

TEST_F(KcsctlMachine, SaysWhatCannotBeDone) {
  const Result nothing = run({"hold", "mill"});
  EXPECT_EQ(nothing.exit_code, 1);
  EXPECT_EQ(nothing.errors, "kcsctl: machines/mill is on no run\n");
  const Result nowhere = run({"run", path("short.ngc"), "--on", "lathe"});
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_NE(nowhere.errors.find("machines/lathe is not attached"), std::string::npos) << nowhere.errors;
  const Result too_strong = run({"run", path("short.ngc"), "--on", "mill", "--machine", "machining-center"});
  EXPECT_EQ(too_strong.exit_code, 1);
  EXPECT_NE(too_strong.errors.find("than the machine has"), std::string::npos) << too_strong.errors;
  begin_long_run();
  const Result too_fast = run({"override", "mill", "201"});
  EXPECT_EQ(too_fast.exit_code, 1);
  EXPECT_EQ(too_fast.errors.rfind("kcsctl: feed_override_percent: ", 0), 0) << too_fast.errors;
  EXPECT_EQ(kcs::test::run({KCSCTL, "machines", "--server", "unix:" + path("nobody")}).exit_code, 3);
}

TEST_F(KcsctlMachine, AnOperatorRunsItWithKeys) {
  TerminalProcess screen(command({"run", path("long.ngc"), "--on", "mill", "--watch"}));
  ASSERT_TRUE(screen.shows("running")) << screen.unseen();
  EXPECT_TRUE(screen.shows("q leave"));
  EXPECT_FALSE(screen.is_as_for_a_shell());
  screen.press('h');
  ASSERT_TRUE(screen.shows("at rest on the path")) << screen.unseen();
  screen.press('-');
  EXPECT_TRUE(screen.shows("override  90 %")) << screen.unseen();
  screen.press('r');
  ASSERT_TRUE(screen.shows("running")) << screen.unseen();
  screen.press('r');
  EXPECT_TRUE(screen.shows("is not held")) << screen.unseen();
  screen.press('a');
  EXPECT_TRUE(screen.shows("y / n")) << screen.unseen();
  screen.press('y');
  EXPECT_TRUE(screen.shows("aborted")) << screen.unseen();
  EXPECT_EQ(screen.wait(), 1);
  EXPECT_TRUE(screen.is_as_for_a_shell());
}

TEST_F(KcsctlMachine, TheViewIsLeftInOrderAndTheRunGoesOn) {
  begin_long_run();
  const auto open = [this] { return std::make_unique<TerminalProcess>(command({"watch", "mill"})); };
  auto screen = open();
  ASSERT_TRUE(screen->shows("q leave")) << screen->unseen();
  screen->press('q');
  EXPECT_EQ(screen->wait(), 0);
  EXPECT_TRUE(screen->is_as_for_a_shell());
  screen = open();
  ASSERT_TRUE(screen->shows("q leave")) << screen->unseen();
  screen->press(kCtrlC);
  EXPECT_EQ(screen->wait(), -SIGINT);
  EXPECT_TRUE(screen->is_as_for_a_shell());
  EXPECT_TRUE(screen->unseen().ends_with("\x1b[?25h")) << "the cursor is back";
  screen = open();
  ASSERT_TRUE(screen->shows("q leave")) << screen->unseen();
  kill(screen->pid(), SIGTERM);
  EXPECT_EQ(screen->wait(), -SIGTERM);
  EXPECT_TRUE(screen->is_as_for_a_shell());
  EXPECT_EQ(machine()["state"], "running");
}

}  // namespace
}  // namespace kcs::test
