#include "client/sdk/text_file.h"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

namespace kcs::client {

std::string read_text_file(const std::filesystem::path& file) {
  errno = 0;
  const std::ifstream stream(file, std::ios::binary);
  const bool is_folder = std::filesystem::is_directory(file);
  if (!stream || is_folder) throw std::system_error(is_folder ? EISDIR : errno, std::generic_category(), file.string());
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

}  // namespace kcs::client
