#include "client/common/program_file.h"

#include <fmt/core.h>

#include "client/common/file_error.h"

namespace kcs::client {

std::ifstream open_program(const std::filesystem::path& file) {
  std::ifstream program(file, std::ios::binary);
  if (!program || std::filesystem::is_directory(file)) {
    throw FileError(fmt::format("{}: cannot be read; check its name and its permissions", file.string()));
  }
  return program;
}

}  // namespace kcs::client
