// What an exit code says to a script.
#pragma once

namespace kcs::client {

enum ExitCode {
  kDone = 0,
  kRefused = 1,   // the program, the machine or an option cannot be planned; a run did not finish
  kUsage = 2,     // the command line is wrong
  kNoServer = 3,  // no server answers, or the connection broke off
  kNoFile = 4,    // a file cannot be read or written, or a helper program is missing
  kDefect = 5,    // an error inside kcs
  kStarved = 6,   // kcs-gateway: no setpoint was there when one was due
};

// The same for people, as the end of a help text; kStarved is left to kcs-gateway.
inline constexpr const char* kExitCodeHelp =
    "Exit codes: 0 done, 1 refused (what cannot be planned, with its place),\n"
    "2 wrong command line, 3 no server answers, 4 a file cannot be read or written,\n"
    "5 an error inside kcs";

}  // namespace kcs::client
