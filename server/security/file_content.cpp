#include "server/security/file_content.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace kcs::security {

std::string file_content(const std::string& file) {
  errno = 0;
  const std::ifstream stream(file, std::ios::binary);
  const bool is_folder = std::filesystem::is_directory(file);
  if (!stream || is_folder) {
    throw std::runtime_error(file + ": cannot be read (" + std::generic_category().message(is_folder ? EISDIR : errno) +
                             "); check its name and its permissions");
  }
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

}  // namespace kcs::security
