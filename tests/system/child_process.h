// A program under test, run as a process of its own.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace kcs::test {

// Starts at construction, is killed at destruction if it still runs. Its standard output is read line by line, its
// standard error is kept in a file.
class ChildProcess {
 public:
  // arguments[0] is the program. Throws std::system_error if it cannot be started.
  explicit ChildProcess(const std::vector<std::string>& arguments);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // The next line of the standard output without its end; empty at the end of the output or after a minute of silence.
  std::string read_line();

  void send_signal(int number) const;

  // Waits for up to a minute. The exit code; −N if signal N ended it; throws std::runtime_error if it still runs.
  int wait();

  // What it wrote to its standard error so far.
  std::string errors() const;

  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = -1;  // −1 once it was waited for
  int output_ = -1;
  std::string errors_file_;
};

// What a program did, once it has ended.
struct Result {
  int exit_code = -1;
  std::string output;  // up to the first empty line
  std::string errors;
};

// Runs a program until it ends by itself; arguments[0] is the program.
Result run(const std::vector<std::string>& arguments);

}  // namespace kcs::test
