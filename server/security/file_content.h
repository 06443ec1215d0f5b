// The content of a small file that the server needs.
#pragma once

#include <string>

namespace kcs::security {

// Throws std::runtime_error, with the file's name and the reason, if it cannot be read.
std::string file_content(const std::string& file);

}  // namespace kcs::security
