// A program under test that believes to be on a terminal.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace kcs::test {

// Started at construction, killed at destruction if it still runs. The terminal has 100 columns and 30 lines.
class TerminalProcess {
 public:
  // arguments[0] is the program. Throws std::system_error if it cannot be started.
  explicit TerminalProcess(const std::vector<std::string>& arguments);
  ~TerminalProcess();
  TerminalProcess(const TerminalProcess&) = delete;
  TerminalProcess& operator=(const TerminalProcess&) = delete;

  // Reads until `text` has come since the last call that found its own; false if it does not within a minute.
  bool shows(const std::string& text);
  // What has been read and not yet been looked for.
  const std::string& unseen() const { return unseen_; }

  void press(char key) const;
  // Whether the terminal shows what is typed, and hands it over line by line: as it is for a shell.
  bool is_as_for_a_shell() const;

  pid_t pid() const { return pid_; }
  // Waits for up to a minute. The exit code; −N if signal N ended it; throws std::runtime_error if it still runs.
  int wait();

 private:
  bool read_some();  // false: nothing came for a moment, or nothing will

  pid_t pid_ = -1;  // −1 once it was waited for
  int terminal_ = -1;
  std::string unseen_;
};

}  // namespace kcs::test
