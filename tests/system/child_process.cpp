#include "tests/system/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace kcs::test {
namespace {

constexpr std::chrono::seconds kPatience{60};

void require(int error, const char* what) {
  if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments) {
  std::string pattern = "/tmp/kcs-child-XXXXXX";
  const int errors = mkstemp(pattern.data());
  require(errors < 0 ? errno : 0, "mkstemp");
  errors_file_ = pattern;
  int ends[2];
  require(pipe2(ends, O_CLOEXEC) < 0 ? errno : 0, "pipe2");

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const int failed = posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(errors);
  close(ends[1]);
  output_ = ends[0];
  require(failed, arguments[0].c_str());
}

ChildProcess::~ChildProcess() {
  if (pid_ > 0) {
    send_signal(SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  close(output_);
  unlink(errors_file_.c_str());
}

std::string ChildProcess::read_line() {
  std::string line;
  while (true) {
    pollfd readable{.fd = output_, .events = POLLIN, .revents = 0};
    char character = 0;
    if (poll(&readable, 1, std::chrono::milliseconds(kPatience).count()) != 1) return {};
    if (read(output_, &character, 1) != 1 || character == '\n') return line;
    line.push_back(character);
  }
}

void ChildProcess::send_signal(int number) const { kill(pid_, number); }

int ChildProcess::wait() {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  int status = 0;
  while (waitpid(pid_, &status, WNOHANG) != pid_) {
    if (std::chrono::steady_clock::now() > end) throw std::runtime_error("the process does not end: " + errors());
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::string ChildProcess::errors() const {
  std::ostringstream text;
  text << std::ifstream(errors_file_).rdbuf();
  return text.str();
}

Result run(const std::vector<std::string>& arguments) {
  ChildProcess process(arguments);
  Result result;
  for (std::string line = process.read_line(); !line.empty(); line = process.read_line()) result.output += line + "\n";
  result.exit_code = process.wait();
  result.errors = process.errors();
  return result;
}

}  // namespace kcs::test
