// Writes into a store and says so, until it is killed or has written enough:
//   store_writer DATABASE PASSWORD_FILE OWNER FIRST_NUMBER COUNT
// Each line of its output is something that the store has acknowledged: "accepted 7", "finished 7", "removed 7".
#include "tests/store/writer.h"

#include <cstdio>
#include <exception>
#include <thread>

namespace kcs::store {
namespace {

void say(const char* what, std::uint64_t number) {
  std::printf("%s %llu\n", what, static_cast<unsigned long long>(number));
  std::fflush(stdout);
}

// Does it until the database is there.
template <typename Call>
void insist(const Call& call) {
  while (true) {
    try {
      call();
      return;
    } catch (const StoreUnavailable&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
}

void write(Store& store, const std::string& owner, std::uint64_t number) {
  const std::string name = plan_name(number);
  const std::string bytes = written_bytes(number);
  const std::string plan = written_plan(number);
  const Request request = {.name = name, .machine_name = "mill", .bytes = bytes};
  if (is_finished_at_once(number)) {
    insist([&] { store.accept_finished(owner, request, {.plan = plan, .cycle_time = 1}); });
    say("finished", number);
    return;
  }
  insist([&] { store.accept(owner, request); });
  say("accepted", number);
  if (is_finished_later(number)) {
    insist([&] { store.finish(name, {.plan = plan, .cycle_time = 1}); });
    say("finished", number);
  }
  if (is_removed(number)) {
    insist([&] { store.remove(owner, name); });
    say("removed", number);
  }
}

}  // namespace
}  // namespace kcs::store

int main(int argc, char** argv) {
  if (argc != 6) return 2;
  try {
    kcs::store::Store store({.database = argv[1], .password_file = argv[2]});
    const std::uint64_t first = std::stoull(argv[4]);
    const std::uint64_t count = std::stoull(argv[5]);
    for (std::uint64_t number = first; number < first + count; ++number) kcs::store::write(store, argv[3], number);
    return 0;
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "store_writer: %s\n", failure.what());
    return 1;
  }
}
