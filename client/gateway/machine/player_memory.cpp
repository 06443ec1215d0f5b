#include "client/gateway/machine/player_memory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <system_error>

#include "client/common/file_error.h"

namespace kcs::gateway {
namespace {

constexpr std::size_t kSize = sizeof(kcs_player_memory);

class File {
 public:
  explicit File(const std::string& name) : descriptor_(shm_open(name.c_str(), O_RDWR | O_CLOEXEC, 0)) {}
  ~File() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

// False if another gateway has it. The component holds the file, too, by a lock of another kind (flock).
bool lock(const File& file) {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return fcntl(file.descriptor(), F_OFD_SETLK, &whole) == 0;
}

std::string last_error() { return std::generic_category().message(errno); }

}  // namespace

PlayerMemory make_player_memory(const kcs_player_profile& profile) {
  PlayerMemory memory = std::make_shared<kcs_player_memory>();
  kcs_player_prepare(memory.get(), &profile);
  return memory;
}

PlayerMemory open_player_memory(const std::string& component) {
  const std::string name = "/kcs-" + component;
  const auto file = std::make_shared<File>(name);
  struct stat status {};
  if (file->descriptor() < 0 || fstat(file->descriptor(), &status) != 0) {
    throw client::FileError(
        fmt::format("shared memory {}: {}; load the component kcs_player into HAL first, and run the "
                    "gateway as the same user",
                    name, last_error()));
  }
  const std::string other_version = fmt::format("shared memory {} is of a component of another version", name);
  if (static_cast<std::size_t>(status.st_size) < kSize) throw client::FileError(other_version);
  if (!lock(*file)) throw client::FileError(fmt::format("shared memory {}: another gateway feeds this machine", name));
  void* address = mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_SHARED, file->descriptor(), 0);
  if (address == MAP_FAILED) throw client::FileError(fmt::format("shared memory {}: {}", name, last_error()));
  PlayerMemory memory(static_cast<kcs_player_memory*>(address),
                      [file](kcs_player_memory* mapped) { munmap(mapped, kSize); });
  const std::uint64_t magic = std::atomic_ref(memory->magic).load();
  if (magic == 0) throw client::FileError(fmt::format("shared memory {}: HAL's threads do not run; start them", name));
  if (magic != KCS_PLAYER_MAGIC) throw client::FileError(other_version);
  return memory;
}

}  // namespace kcs::gateway
