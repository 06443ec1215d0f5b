#include <gtest/gtest.h>

#include <sstream>
#include <utility>
#include <vector>

#include "client/cli/options.h"

namespace kcs::cli {
namespace {

struct Parsed {
  Options options;
  std::optional<client::Message> message;
};

Parsed parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "kcsctl");
  Parsed parsed;
  parsed.message = parse_command_line(static_cast<int>(arguments.size()), arguments.data(), parsed.options);
  return parsed;
}

TEST(CommandLine, DefaultsNeedOnlyAFile) {
  const auto [options, message] = parse({"plan", "part.ngc"});
  ASSERT_FALSE(message.has_value()) << message->text;
  EXPECT_EQ(options.command, Command::kPlan);
  EXPECT_EQ(options.file, "part.ngc");
  EXPECT_EQ(options.machine, "router");
  EXPECT_FALSE(options.plan.tolerance_mm.has_value());
  EXPECT_EQ(options.plan.strategy, client::CornerStrategy::kAuto);
  EXPECT_EQ(options.server.address, "");
  EXPECT_FALSE(options.server.tls);
}

TEST(CommandLine, EveryOptionArrives) {
  const auto [options, message] = parse({"stream",
                                         "-",
                                         "-o",
                                         "out.csv",
                                         "--machine",
                                         "m.toml",
                                         "--tolerance",
                                         "0.05",
                                         "--tolerance-kind",
                                         "corner",
                                         "--strategy",
                                         "exact-stop",
                                         "--feed",
                                         "100",
                                         "--start",
                                         "-1,2,-3.5",
                                         "--server",
                                         "localhost:1",
                                         "--period",
                                         "0.004",
                                         "--channels",
                                         "jerk,velocity,path-position,segment,line"});
  ASSERT_FALSE(message.has_value()) << message->text;
  EXPECT_EQ(options.command, Command::kStream);
  EXPECT_EQ(options.file, "-");
  EXPECT_EQ(options.output, "out.csv");
  EXPECT_EQ(options.machine, "m.toml");
  EXPECT_EQ(options.plan.tolerance_mm, 0.05);
  EXPECT_EQ(options.plan.tolerance_kind, client::ToleranceKind::kCornerDistance);
  EXPECT_EQ(options.plan.strategy, client::CornerStrategy::kExactStop);
  EXPECT_EQ(options.plan.feed_mm_s, 100);
  EXPECT_EQ(options.plan.start_mm, (std::vector<double>{-1, 2, -3.5}));
  EXPECT_EQ(options.server.address, "localhost:1");
  EXPECT_EQ(options.period_s, 0.004);
  EXPECT_EQ(options.channels, (std::vector<client::Channel>{client::Channel::kJerk, client::Channel::kVelocity,
                                                            client::Channel::kPathPosition, client::Channel::kSegment,
                                                            client::Channel::kLine}));
}

TEST(CommandLine, CertificatesMeanTls) {
  const auto [options, message] = parse({"plan", "part.ngc", "--server", "localhost:1", "--tls-ca", "ca.pem",
                                         "--tls-cert", "own.pem", "--tls-key", "key.pem", "--token-file", "token"});
  ASSERT_FALSE(message.has_value()) << message->text;
  EXPECT_TRUE(options.server.tls);
  EXPECT_EQ(options.server.ca_file, "ca.pem");
  EXPECT_EQ(options.server.certificate_file, "own.pem");
  EXPECT_EQ(options.server.key_file, "key.pem");
  EXPECT_EQ(options.server.token_file, "token");
  EXPECT_TRUE(parse({"plan", "part.ngc", "--server", "localhost:1", "--tls"}).options.server.tls);
  EXPECT_FALSE(parse({"plan", "part.ngc", "--server", "localhost:1", "--token-file", "token"}).options.server.tls);
}

TEST(CommandLine, CertificatesWithoutTheirServerOrKeyAreRefused) {
  for (const std::vector<const char*>& arguments :
       {std::vector{"plan", "part.ngc", "--tls"}, std::vector{"plan", "part.ngc", "--tls-ca", "ca.pem"},
        std::vector{"plan", "part.ngc", "--server", "localhost:1", "--tls-cert", "own.pem"},
        std::vector{"plan", "part.ngc", "--server", "localhost:1", "--tls-key", "key.pem"}}) {
    const Parsed parsed = parse(arguments);
    ASSERT_TRUE(parsed.message.has_value()) << arguments.back();
    EXPECT_TRUE(parsed.message->is_error);
  }
}

TEST(CommandLine, LiveTakesWhatStreamTakesAndSpeeds) {
  const auto [options, message] = parse({"live", "-", "--channels", "jerk", "--json", "--start-speed", "1",
                                         "--start-acceleration", "-2", "--end-speed", "3"});
  ASSERT_FALSE(message.has_value()) << message->text;
  EXPECT_EQ(options.command, Command::kLive);
  EXPECT_EQ(options.output, "") << "setpoints only where they are wanted";
  EXPECT_TRUE(options.json);
  EXPECT_EQ(options.channels, (std::vector<client::Channel>{client::Channel::kJerk}));
  EXPECT_EQ(options.plan.start_speed_mm_s, 1);
  EXPECT_EQ(options.plan.start_acceleration_mm_s2, -2);
  EXPECT_EQ(options.plan.end_speed_mm_s, 3);
}

TEST(CommandLine, NamesOfChoicesMayBeInCapitals) {
  const auto [options, message] = parse({"plan", "part.ngc", "--strategy", "Exact-Stop", "--tolerance-kind", "CORNER"});
  ASSERT_FALSE(message.has_value()) << message->text;
  EXPECT_EQ(options.plan.strategy, client::CornerStrategy::kExactStop);
  EXPECT_EQ(options.plan.tolerance_kind, client::ToleranceKind::kCornerDistance);
}

TEST(CommandLine, EveryStrategyThatMayBeAskedForHasAName) {
  for (const auto& [name, strategy] : {std::pair{"auto", client::CornerStrategy::kAuto},
                                       {"interrupted", client::CornerStrategy::kInterrupted},
                                       {"uninterrupted", client::CornerStrategy::kUninterrupted},
                                       {"blended", client::CornerStrategy::kBlended},
                                       {"exact-stop", client::CornerStrategy::kExactStop}}) {
    const auto [options, message] = parse({"plan", "part.ngc", "--strategy", name});
    ASSERT_FALSE(message.has_value()) << message->text;
    EXPECT_EQ(options.plan.strategy, strategy) << name;
  }
}

TEST(CommandLine, RunsPlanForTheMachineItselfUnlessToldOtherwise) {
  const auto [options, message] =
      parse({"run", "part.ngc", "--on", "mill", "--server", "localhost:1", "--override", "80", "--watch"});
  ASSERT_FALSE(message.has_value()) << message->text;
  EXPECT_EQ(options.command, Command::kRun);
  EXPECT_EQ(options.file, "part.ngc");
  EXPECT_EQ(options.run.machine, "mill");
  EXPECT_EQ(options.run.profile, "") << "the machine's own";
  EXPECT_EQ(options.run.feed_override_percent, 80);
  EXPECT_TRUE(options.run.watch);
  EXPECT_TRUE(options.plan.start_mm.empty()) << "where it stands";
  const Parsed other = parse({"run", "part.ngc", "--on", "mill", "--server", "localhost:1", "--machine", "router"});
  EXPECT_EQ(other.options.run.profile, "router");
  const Parsed planned = parse({"run", "--plan", "plans/1", "--on", "mill", "--server", "localhost:1"});
  EXPECT_EQ(planned.options.run.plan, "plans/1");
}

TEST(CommandLine, RunsAreOperatedByNameOrMachine) {
  const std::vector<std::pair<const char*, Command>> commands = {
      {"hold", Command::kHold}, {"resume", Command::kResume}, {"abort", Command::kAbort}, {"watch", Command::kWatch}};
  for (const auto& [name, command] : commands) {
    const auto [options, message] = parse({name, "machines/mill", "--server", "localhost:1", "--json"});
    ASSERT_FALSE(message.has_value()) << message->text;
    EXPECT_EQ(options.command, command);
    EXPECT_EQ(options.run.run, "machines/mill");
    EXPECT_TRUE(options.json);
  }
  const auto [options, message] = parse({"override", "mill", "50", "--take-over", "--server", "localhost:1"});
  ASSERT_FALSE(message.has_value()) << message->text;
  EXPECT_EQ(options.command, Command::kOverride);
  EXPECT_EQ(options.run.feed_override_percent, 50);
  EXPECT_TRUE(options.run.take_over);
}

TEST(CommandLine, WrongOnesAreRefused) {
  for (const std::vector<const char*>& arguments :
       std::vector<std::vector<const char*>>{{},
                                             {"plan"},
                                             {"dance", "part.ngc"},
                                             {"plan", "part.ngc", "--tolerance", "much"},
                                             {"plan", "part.ngc", "--strategy", "fast"},
                                             {"plan", "part.ngc", "--strategy", "overlapping"},
                                             {"plan", "part.ngc", "--nonsense"},
                                             {"stream", "part.ngc"},
                                             {"machines"},
                                             {"hold", "mill"},
                                             {"hold", "--server", "x:1"},
                                             {"override", "mill", "--server", "x:1"},
                                             {"run", "--on", "mill", "--server", "x:1"},
                                             {"run", "part.ngc", "--server", "x:1"},
                                             {"run", "a.ngc", "--plan", "b", "--on", "mill", "--server", "x:1"},
                                             {"stream", "part.ngc", "-o", "x.csv", "--channels", "colour"}}) {
    const auto [options, message] = parse(arguments);
    ASSERT_TRUE(message.has_value());
    EXPECT_TRUE(message->is_error) << message->text;
    EXPECT_EQ(message->text.rfind("kcsctl: ", 0), 0) << message->text;
  }
}

TEST(CommandLine, HelpFitsEightyColumns) {
  for (const std::vector<const char*>& arguments : std::vector<std::vector<const char*>>{{"--help"},
                                                                                         {"plan", "--help"},
                                                                                         {"stream", "--help"},
                                                                                         {"corners", "--help"},
                                                                                         {"plot", "--help"},
                                                                                         {"run", "--help"},
                                                                                         {"override", "--help"},
                                                                                         {"watch", "--help"}}) {
    const auto [options, message] = parse(arguments);
    ASSERT_TRUE(message.has_value());
    EXPECT_FALSE(message->is_error);
    std::istringstream lines(message->text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80) << line;
  }
}

}  // namespace
}  // namespace kcs::cli
