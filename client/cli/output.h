// What a command has to say.
#pragma once

#include <string>

namespace kcs::cli {

// Writes to standard output, at once. Throws client::FileError if that cannot be done.
void print(const std::string& text);

}  // namespace kcs::cli
