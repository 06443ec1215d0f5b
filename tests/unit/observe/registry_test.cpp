#include "server/observe/registry.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include "server/observe/server_metrics.h"
#include "tests/observe/exposition_reader.h"

namespace kcs::observe {
namespace {

using test::read_exposition;

TEST(Registry, ShowsItsMetricsInTheOrderInWhichTheyCame) {
  Registry registry;
  registry.counter({"kcs_parts_total", "Parts made."}).add(3);
  Family<Gauge>& doors = registry.gauges({"kcs_doors", "Doors that are open.", {"side", "floor"}});
  doors.with({"left", "2"}).add(1);
  doors.with({"left", "1"}).add(-4);
  registry.read_gauge({"kcs_load", "Load."}, [] { return 0.25; });
  EXPECT_EQ(registry.exposition(),
            "# HELP kcs_parts_total Parts made.\n"
            "# TYPE kcs_parts_total counter\n"
            "kcs_parts_total 3\n"
            "# HELP kcs_doors Doors that are open.\n"
            "# TYPE kcs_doors gauge\n"
            "kcs_doors{side=\"left\",floor=\"1\"} -4\n"
            "kcs_doors{side=\"left\",floor=\"2\"} 1\n"
            "# HELP kcs_load Load.\n"
            "# TYPE kcs_load gauge\n"
            "kcs_load 0.25\n");
}

TEST(Registry, EscapesWhatWouldBreakALine) {
  Registry registry;
  registry.counters({"kcs_x_total", "One\\two\nthree \"four\".", {"what"}}).with({"a\"b\\c\nd"}).add();
  EXPECT_EQ(registry.exposition(),
            "# HELP kcs_x_total One\\\\two\\nthree \"four\".\n"
            "# TYPE kcs_x_total counter\n"
            "kcs_x_total{what=\"a\\\"b\\\\c\\nd\"} 1\n");
}

TEST(Registry, SpellsNumbersAsPrometheusDoes) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const auto& [value, text] :
       std::vector<std::pair<double, std::string>>{{kInfinity, "+Inf"},
                                                   {-kInfinity, "-Inf"},
                                                   {std::numeric_limits<double>::quiet_NaN(), "NaN"},
                                                   {0.1, "0.1"}}) {
    Registry registry;
    registry.read_gauge({"kcs_x", "X."}, [value = value] { return value; });
    EXPECT_TRUE(registry.exposition().ends_with("\nkcs_x " + text + "\n")) << registry.exposition();
  }
}

TEST(Registry, CountsBeyondWhatADoubleHolds) {
  Registry registry;
  registry.counter({"kcs_x_total", "X."}).add((std::uint64_t{1} << 53) + 1);
  EXPECT_TRUE(registry.exposition().ends_with("kcs_x_total 9007199254740993\n")) << registry.exposition();
}

TEST(Registry, BucketsHoldAllDurationsUpToTheirBound) {
  Registry registry;
  Histogram& histogram = registry.histograms({"kcs_x_seconds", "X.", {"kind"}}).with({"a"});
  for (const double seconds : {0.0, 0.01, 0.0101, 3600.0, 1e9})
    histogram.observe(std::chrono::duration<double>(seconds));
  const auto samples = read_exposition(registry.exposition());
  EXPECT_EQ(samples.at("kcs_x_seconds_bucket{kind=\"a\",le=\"0.0005\"}"), 1);
  EXPECT_EQ(samples.at("kcs_x_seconds_bucket{kind=\"a\",le=\"0.005\"}"), 1);
  EXPECT_EQ(samples.at("kcs_x_seconds_bucket{kind=\"a\",le=\"0.01\"}"), 2);
  EXPECT_EQ(samples.at("kcs_x_seconds_bucket{kind=\"a\",le=\"0.025\"}"), 3);
  EXPECT_EQ(samples.at("kcs_x_seconds_bucket{kind=\"a\",le=\"1800\"}"), 3);
  EXPECT_EQ(samples.at("kcs_x_seconds_bucket{kind=\"a\",le=\"3600\"}"), 4);
  EXPECT_EQ(samples.at("kcs_x_seconds_bucket{kind=\"a\",le=\"+Inf\"}"), 5);
  EXPECT_EQ(samples.at("kcs_x_seconds_count{kind=\"a\"}"), 5);
  EXPECT_DOUBLE_EQ(samples.at("kcs_x_seconds_sum{kind=\"a\"}"), 1e9 + 3600.0201);
}

TEST(Registry, StopwatchObservesItsLifetime) {
  Registry registry;
  Histogram& histogram = registry.histogram({"kcs_x_seconds", "X."});
  {
    const Histogram::Stopwatch stopwatch(histogram);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    EXPECT_EQ(histogram.count(), 0U);
  }
  EXPECT_EQ(histogram.count(), 1U);
  EXPECT_GE(read_exposition(registry.exposition()).at("kcs_x_seconds_sum"), 0.002);
}

TEST(Registry, RefusesNamesThatPrometheusDoesNotTake) {
  Registry registry;
  for (const std::string name : {"", "1x", "a-b", "a b", "ä", "a\n"}) {
    EXPECT_THROW(registry.counter({name, "X."}), std::logic_error) << name;
  }
  for (const std::string label : {"", "1x", "a:b", "__x", "le"}) {
    EXPECT_THROW(registry.counters({"kcs_x_total", "X.", {label}}), std::logic_error) << label;
  }
  EXPECT_EQ(registry.exposition(), "");
}

TEST(Registry, TakesEachNameOnce) {
  Registry registry;
  registry.counter({"kcs_x_total", "X."});
  EXPECT_THROW(registry.gauge({"kcs_x_total", "Y."}), std::logic_error);
}

TEST(Registry, WantsAValueForEachLabel) {
  Registry registry;
  Family<Counter>& family = registry.counters({"kcs_x_total", "X.", {"a", "b"}});
  EXPECT_THROW(family.with({"1"}), std::logic_error);
  EXPECT_THROW(family.with({}), std::logic_error);
}

TEST(Registry, CountsWhatManyThreadsDoWhileItIsRead) {
  constexpr int kThreads = 4;
  constexpr int kRounds = 2000;
  Registry registry;
  ServerMetrics metrics(registry);
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&] {
      for (int round = 0; round < kRounds; ++round) {
        const Gauge::Share running(metrics.rpcs_running.with({"GetPlan"}));
        metrics.setpoints_sent.add(5);
        metrics.rpcs.with({"GetPlan", std::to_string(round % 7)}).add();
        metrics.planning_duration.observe(std::chrono::milliseconds(1));
      }
    });
  }
  for (int i = 0; i < 50; ++i) read_exposition(registry.exposition());  // sound at any moment
  for (std::thread& thread : threads) thread.join();
  const auto samples = read_exposition(registry.exposition());
  EXPECT_EQ(samples.at("kcs_setpoints_sent_total"), kThreads * kRounds * 5);
  EXPECT_EQ(samples.at("kcs_rpcs_running{method=\"GetPlan\"}"), 0);
  EXPECT_EQ(samples.at("kcs_rpcs_total{method=\"GetPlan\",code=\"0\"}"), kThreads * ((kRounds + 6) / 7));
  EXPECT_EQ(samples.at("kcs_planning_duration_seconds_count"), kThreads * kRounds);
  EXPECT_NEAR(samples.at("kcs_planning_duration_seconds_sum"), kThreads * kRounds * 1e-3, 1e-6);
}

}  // namespace
}  // namespace kcs::observe
