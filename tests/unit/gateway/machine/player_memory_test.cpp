#include "client/gateway/machine/player_memory.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "client/common/file_error.h"
#include "tests/unit/gateway/machine/straight_motion.h"

namespace kcs::gateway {
namespace {

// Shared memory as the component makes it.
class Component {
 public:
  explicit Component(std::size_t size = sizeof(kcs_player_memory))
      : descriptor_(shm_open(path().c_str(), O_CREAT | O_EXCL | O_RDWR, 0600)) {
    flock(descriptor_, LOCK_EX);  // as the component does
    if (descriptor_ < 0 || ftruncate(descriptor_, static_cast<off_t>(size)) != 0) throw std::runtime_error("no memory");
    if (size < sizeof(kcs_player_memory)) return;
    memory_ = static_cast<kcs_player_memory*>(mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0));
  }
  ~Component() {
    if (memory_ != nullptr) munmap(memory_, sizeof *memory_);
    close(descriptor_);
    shm_unlink(path().c_str());
  }
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;

  static std::string name() { return "test-" + std::to_string(getpid()); }
  kcs_player_memory& memory() { return *memory_; }

 private:
  static std::string path() { return "/kcs-" + name(); }
  int descriptor_;
  kcs_player_memory* memory_ = nullptr;
};

std::string problem() {
  try {
    open_player_memory(Component::name());
    return "none";
  } catch (const client::FileError& error) {
    return error.what();
  }
}

TEST(PlayerMemory, IsSharedWithTheComponent) {
  Component component;
  const kcs_player_profile profile = test_profile();
  kcs_player_prepare(&component.memory(), &profile);
  const PlayerMemory memory = open_player_memory(Component::name());
  EXPECT_EQ(memory->profile.velocity_mm_s[1], profile.velocity_mm_s[1]);
  kcs_player_ask_to_stop(memory.get());
  EXPECT_EQ(component.memory().stop_requests, 1u);
}

TEST(PlayerMemory, BelongsToOneGatewayAtATime) {
  Component component;
  const kcs_player_profile profile = test_profile();
  kcs_player_prepare(&component.memory(), &profile);
  PlayerMemory first = open_player_memory(Component::name());
  EXPECT_NE(problem().find("another gateway"), std::string::npos) << problem();
  first.reset();
  EXPECT_EQ(problem(), "none");
}

TEST(PlayerMemory, MissingComponentIsNamedWithTheRemedy) {
  EXPECT_NE(problem().find("load the component"), std::string::npos) << problem();
}

TEST(PlayerMemory, ComponentOfAnotherVersionIsRefused) {
  {
    Component smaller(4096);
    EXPECT_NE(problem().find("another version"), std::string::npos) << problem();
  }
  Component other;
  other.memory().magic = KCS_PLAYER_MAGIC + 1;
  EXPECT_NE(problem().find("another version"), std::string::npos) << problem();
}

TEST(PlayerMemory, ComponentThatDoesNotTickYetIsNamedWithTheRemedy) {
  const Component component;
  EXPECT_NE(problem().find("threads do not run"), std::string::npos) << problem();
}

}  // namespace
}  // namespace kcs::gateway
