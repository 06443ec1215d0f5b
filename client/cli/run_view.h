// A run as an operator sees it on a terminal.
#pragma once

#include <string>
#include <vector>

#include "client/sdk/run.h"

namespace kcs::cli {

// The lines of the view, for at least 80 columns, without ends of lines. Numbers that change stay in their columns. The
// state is coloured by the terminal's control sequences. window_s: the motion that the machine holds when all is well.
std::vector<std::string> run_view(const client::Run& run, double window_s);

// In the colour of what the operator must not overlook.
std::string alarm(const std::string& text);

// Where a terminal is not: the same in one line.
std::string run_line(const client::Run& run);

}  // namespace kcs::cli
