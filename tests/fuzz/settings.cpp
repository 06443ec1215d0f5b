// Any bytes as the configuration file and as the file of tokens: read, or refused with the line.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "server/service/config.h"
#include "server/service/security_settings.h"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

// A file in memory.
class File {
 public:
  explicit File(const std::string& content) {
    require(descriptor_ >= 0 &&
            write(descriptor_, content.data(), content.size()) == static_cast<ssize_t>(content.size()));
  }
  ~File() { close(descriptor_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  const int descriptor_ = memfd_create("settings", MFD_CLOEXEC);
};

template <typename Read>
void read(const std::string& file, const Read& read) {
  try {
    read();
  } catch (const std::runtime_error& refused) {
    require(std::string(refused.what()).starts_with(file + ":"));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const File file(text);
  read(file.path(), [&file] { kcs::service::load_config(file.path()); });
  read("tokens", [&text] { kcs::service::parse_tokens(text, "tokens"); });
  return 0;
}
