#include "client/common/program_file.h"

#include <fmt/core.h>

#include <system_error>

#include "client/common/file_error.h"

namespace kcs::client {

std::ifstream open_program(const std::filesystem::path& file) {
  std::ifstream program(file, std::ios::binary);
  if (!program || std::filesystem::is_directory(file)) {
    throw FileError(fmt::format("{}: cannot be read; check its name and its permissions", file.string()));
  }
  return program;
}

void require_not_the_program(const std::filesystem::path& program, const std::filesystem::path& output) {
  std::error_code not_both_there;
  if (!std::filesystem::equivalent(program, output, not_both_there)) return;
  throw FileError(output.string() + ": is the program itself and would be overwritten; name another file");
}

}  // namespace kcs::client
