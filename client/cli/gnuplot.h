// Runs gnuplot.
#pragma once

#include <string>

namespace kcs::cli {

// Hands `script` to a gnuplot process and waits for it. Throws client::FileError if gnuplot is not installed or does
// not take the script.
void run_gnuplot(const std::string& script);

}  // namespace kcs::cli
