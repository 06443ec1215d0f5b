// hal_feeder MEMORY LENGTH: what the gateway is to the HAL component: feeds one run along a line of LENGTH mm through
// the shared memory /kcs-MEMORY, from wherever the player has come to, and ends with the run. Says "feeding"
// when the player has its first batch, and "end". It keeps nothing that it
// does not find in the memory, so that it may be killed at any instant.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "tests/line_motion/line_motion.h"

namespace {

constexpr std::uint64_t kTicksAhead = 60;

kcs_player_memory* open_memory(const std::string& name) {
  const int file = shm_open(("/kcs-" + name).c_str(), O_RDWR, 0);
  void* memory =
      file < 0 ? MAP_FAILED : mmap(nullptr, sizeof(kcs_player_memory), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) {
    std::perror("hal_feeder: shared memory");
    std::exit(1);
  }
  return static_cast<kcs_player_memory*>(memory);
}

void say(const char* words) {
  std::puts(words);
  std::fflush(stdout);
}

// Where the last of the setpoints that were put comes out.
std::uint64_t end_of(const kcs_player_batch& batch) { return batch.first_tick + batch.setpoints; }

void feed(kcs_player_memory& memory, double length) {
  const kcs::test::Line line;
  kcs::test::LineRun run(line, {}, memory.profile.period_s, 20, length);
  kcs_player_report report{};
  std::optional<std::uint64_t> fed_branch;
  std::uint64_t fed_to = 0;
  bool begins = false;
  do {
    if (!kcs_player_read(&memory, &report)) continue;
    const bool rests = report.state == KCS_PLAYER_READY || report.state == KCS_PLAYER_HELD;
    if (rests && fed_branch != report.branch && report.batches == memory.put) {
      run.begin(1, report.branch, report.played, line.place_of(report.command_mm));
      begins = !fed_branch;
      fed_branch = report.branch;
      fed_to = report.played;
    }
    kcs_player_batch* slot =
        run.over() || fed_to > report.played + kTicksAhead ? nullptr : kcs_player_free_slot(&memory);
    if (!slot) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    run.write(*slot);
    fed_to = end_of(*slot);
    kcs_player_put(&memory);
    if (std::exchange(begins, false)) say("feeding");
  } while (report.state != KCS_PLAYER_READY || report.reason != KCS_PLAYER_END);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 2;
  feed(*open_memory(arguments[1]), std::stod(arguments[2]));
  say("end");
}
