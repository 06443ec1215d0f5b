#include "client/cli/gnuplot.h"

#include <signal.h>
#include <sys/wait.h>

#include <cstdio>

#include "client/common/file_error.h"

namespace kcs::cli {
namespace {

// gnuplot must not inherit the signals that CleanUpOnSignal blocks: Ctrl-C is meant for it, too.
std::FILE* start_gnuplot() {
  sigset_t none;
  sigset_t before;
  sigemptyset(&none);
  pthread_sigmask(SIG_SETMASK, &none, &before);
  std::FILE* const pipe = ::popen("command -v gnuplot >/dev/null || exit 127; exec gnuplot", "w");
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return pipe;
}

}  // namespace

void run_gnuplot(const std::string& script) {
  constexpr int kNotFound = 127;  // what the shell says of a program that is not there
  signal(SIGPIPE, SIG_IGN);       // a gnuplot that ends early shows as a failed write
  std::FILE* const pipe = start_gnuplot();
  if (pipe == nullptr) throw client::FileError("gnuplot cannot be started: no process can be made");
  const bool sent = std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
  const int status = ::pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNotFound) {
    throw client::FileError("gnuplot, which draws the picture, is not installed; do: apt-get install gnuplot-nox");
  }
  if (!sent || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw client::FileError("gnuplot could not draw the picture; its own message stands above");
  }
}

}  // namespace kcs::cli
