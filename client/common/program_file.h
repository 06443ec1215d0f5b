// The file of a G-code program.
#pragma once

#include <filesystem>
#include <fstream>

namespace kcs::client {

// Opens a program for reading. Throws FileError if that cannot be done.
std::ifstream open_program(const std::filesystem::path& file);

}  // namespace kcs::client
