// The file of a G-code program.
#pragma once

#include <filesystem>
#include <fstream>

namespace kcs::client {

// Opens a program for reading. Throws FileError if that cannot be done.
std::ifstream open_program(const std::filesystem::path& file);

// Throws FileError if `output` is the program itself: writing would destroy it.
void require_not_the_program(const std::filesystem::path& program, const std::filesystem::path& output);

}  // namespace kcs::client
