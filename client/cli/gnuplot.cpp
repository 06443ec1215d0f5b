#include "client/cli/gnuplot.h"

#include <sys/wait.h>

#include <csignal>
#include <cstdio>

#include "client/cli/file_error.h"

namespace kcs::cli {

void run_gnuplot(const std::string& script) {
  constexpr int kNotFound = 127;  // what the shell says of a program that is not there
  std::signal(SIGPIPE, SIG_IGN);  // a gnuplot that ends early shows as a failed write
  std::FILE* const pipe = ::popen("command -v gnuplot >/dev/null || exit 127; exec gnuplot", "w");
  if (pipe == nullptr) throw FileError("gnuplot cannot be started: no process can be made");
  const bool sent = std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
  const int status = ::pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNotFound) {
    throw FileError("gnuplot, which draws the picture, is not installed; do: apt-get install gnuplot-nox");
  }
  if (!sent || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw FileError("gnuplot could not draw the picture; its own message stands above");
  }
}

}  // namespace kcs::cli
