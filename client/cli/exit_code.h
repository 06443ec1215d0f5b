// What kcsctl's exit code says to a script.
#pragma once

namespace kcs::cli {

enum ExitCode {
  kDone = 0,
  kRefused = 1,   // the program, the machine or an option cannot be planned
  kUsage = 2,     // the command line is wrong
  kNoServer = 3,  // no server answers, or the connection broke off
  kNoFile = 4,    // a file cannot be read or written, or a helper program is missing
  kDefect = 5,    // an error inside kcs
};

}  // namespace kcs::cli
