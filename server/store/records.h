// What goes into the store and what comes out.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kcs::store {

using Time = std::chrono::sys_time<std::chrono::microseconds>;

// Whose plans are meant: one owner's; none: everybody's.
using Whose = std::optional<std::string>;

// A request to be kept. All texts of the store are UTF-8 without zero characters; bytes may be anything.
struct Request {
  std::string name;  // of the plan; the same name always comes with the same bytes and the same machine name
  std::string machine_name;
  std::string_view bytes;  // all that planning it again takes; up to 1 GiB
};

// The outcome of a request that was planned.
struct Finished {
  std::string_view plan;  // all that is shown of the plan; some kB
  double cycle_time = 0;  // s, to be searched by
};

enum class State {
  kAccepted,  // waits, or is being planned
  kFinished,
  kRefused,
};

// A plan as one of its owners sees it, or as its first owner does where everybody's are meant.
struct Record {
  std::string name;
  State state = State::kAccepted;
  Time create_time{};    // when this owner's request was accepted for the first time
  std::string outcome;   // Finished::plan, or the status of the refusal; empty of what is only accepted
  bool to_plan = false;  // accepted, and it is this server's turn to plan it: no other one does
};

// A plan passes if it passes everything that is set.
struct Filter {
  std::optional<std::string> machine_name;
  std::optional<State> state;
  std::optional<Time> created_from;
  std::optional<Time> created_before;
  std::optional<double> cycle_time_at_least;  // s; what is not finished does not pass
  std::optional<double> cycle_time_at_most;   // s
};

struct Page {
  std::vector<Record> records;
  std::string next_page_token;  // empty: this is the last page
};

// What remove() found.
enum class Removal {
  kNotFound,
  kOthersKeepIt,  // it is this owner's no longer, but somebody else's, or a run's that is not over
  kGone,          // nobody has it any more
};

}  // namespace kcs::store
