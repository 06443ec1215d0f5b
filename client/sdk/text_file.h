// The content of a small file. Used inside the library alone.
#pragma once

#include <filesystem>
#include <string>

namespace kcs::client {

// Throws std::system_error that names the file.
std::string read_text_file(const std::filesystem::path& file);

}  // namespace kcs::client
