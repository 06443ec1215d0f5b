#include "server/observe/process_metrics.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>

#include "tests/observe/exposition_reader.h"

namespace kcs::observe {
namespace {

TEST(ProcessMetrics, AreThoseOfThisProcess) {
  Registry registry;
  add_process_metrics(registry);
  const auto before = test::read_exposition(registry.exposition());
  const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  EXPECT_LT(before.at("process_start_time_seconds"), now + 1);
  EXPECT_GT(before.at("process_start_time_seconds"), now - 600);
  EXPECT_GT(before.at("process_resident_memory_bytes"), 1e6);
  EXPECT_LT(before.at("process_resident_memory_bytes"), 1e11);
  EXPECT_GE(before.at("process_max_fds"), before.at("process_open_fds"));

  const int file = open("/dev/null", O_RDONLY | O_CLOEXEC);
  while (std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count() < now + 0.05) {
  }
  const auto after = test::read_exposition(registry.exposition());
  close(file);
  EXPECT_EQ(after.at("process_open_fds"), before.at("process_open_fds") + 1);
  EXPECT_GT(after.at("process_cpu_seconds_total"), before.at("process_cpu_seconds_total"));
  EXPECT_EQ(after.at("process_start_time_seconds"), before.at("process_start_time_seconds"));
}

}  // namespace
}  // namespace kcs::observe
