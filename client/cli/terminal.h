// A few lines at the bottom of a terminal that are drawn again and again, and keys that are read one by one.
#pragma once

#include <termios.h>

#include <chrono>
#include <mutex>
#include <string>
#include <vector>

#include "client/cli/clean_up_on_signal.h"

namespace kcs::cli {

// Standard input and output. From the first drawing to destruction there is no echo, no cursor, and no waiting for the
// end of a line. However it ends (Ctrl-C, SIGTERM and SIGHUP included, which end the process as they do without it),
// the terminal is put back as it was, with what was drawn last above the cursor. Ctrl-Z is off: it would leave it as it
// is. Make it before the threads of the program, gRPC's included: they would take the signals themselves.
class Terminal {
 public:
  static bool is_there();  // both are a terminal

  Terminal();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  // Puts these lines in the place of those drawn before. They are cut at the terminal's right edge.
  void draw(const std::vector<std::string>& lines);

  // The keys pressed, as soon as there are some; empty after `patience`, or if the key is none of a character (an
  // arrow, for instance). Throws client::FileError when the terminal has gone.
  std::string read_keys(std::chrono::milliseconds patience);

 private:
  enum class Phase { kUntouched, kTaken, kRestored };

  void take();
  void restore();

  std::mutex mutex_;  // a signal restores while another thread draws
  Phase phase_ = Phase::kUntouched;
  termios before_{};
  std::vector<std::string> drawn_;
  CleanUpOnSignal restore_at_last_;  // last: it uses all the others
};

}  // namespace kcs::cli
