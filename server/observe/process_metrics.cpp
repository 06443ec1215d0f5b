#include "server/observe/process_metrics.h"

#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <system_error>

namespace kcs::observe {
namespace {

// The number of a field of /proc/self/stat, counted from 1 as in proc(5), at least the third; NaN if it is not there.
double stat_field(int field) {
  std::ifstream file("/proc/self/stat");
  std::string text;
  std::getline(file, text);
  std::istringstream fields(text.substr(text.rfind(')') + 1));  // the second one is the program's name in brackets
  for (int i = 3; i < field; ++i) fields >> text;
  double number = 0;
  return fields >> number ? number : std::numeric_limits<double>::quiet_NaN();
}

double now(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double start_time() {
  constexpr int kStartTime = 22;  // in clock ticks since boot
  const double since_boot = stat_field(kStartTime) / static_cast<double>(sysconf(_SC_CLK_TCK));
  return now(CLOCK_REALTIME) - now(CLOCK_BOOTTIME) + since_boot;
}

double resident_memory() {
  constexpr int kResidentPages = 24;
  return stat_field(kResidentPages) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double open_files() {
  std::error_code error;
  const std::filesystem::directory_iterator files("/proc/self/fd", error);
  return static_cast<double>(std::distance(begin(files), end(files)) - 1);  // less the one that reads the directory
}

double most_files() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  return static_cast<double>(limit.rlim_cur);
}

}  // namespace

void add_process_metrics(Registry& registry) {
  registry.read_gauge({"process_start_time_seconds", "When the process started, in seconds since 1970 (UTC)."},
                      [start = start_time()] { return start; });
  registry.read_counter({"process_cpu_seconds_total", "Processor time that the process took, user and system."},
                        [] { return now(CLOCK_PROCESS_CPUTIME_ID); });
  registry.read_gauge({"process_resident_memory_bytes", "Memory of the process that is in RAM."}, resident_memory);
  registry.read_gauge({"process_open_fds", "Open file descriptors, connections among them."}, open_files);
  registry.read_gauge({"process_max_fds", "Most file descriptors that the process may have open."}, most_files);
}

}  // namespace kcs::observe
