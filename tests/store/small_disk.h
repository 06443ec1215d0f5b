// A disk that is soon full, for real. Only root may make one.
#pragma once

#include <sched.h>
#include <string.h>
#include <sys/mount.h>

#include <cerrno>
#include <string>

#include "tests/files/temporary_folder.h"

namespace kcs::test {

// A disk of 24 MB, for this thread and the processes it starts.
class SmallDisk {
 public:
  SmallDisk() {
    if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("none", folder_.path().c_str(), "tmpfs", 0, "size=24m,mode=777") != 0) {
      why_not_ = strerror(errno);
    }
  }
  ~SmallDisk() {
    if (why_not_.empty()) umount2(folder_.path().c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  const TemporaryFolder& folder() const { return folder_; }
  // Empty if it is there.
  const std::string& why_not() const { return why_not_; }

 private:
  TemporaryFolder folder_;
  std::string why_not_;
};

}  // namespace kcs::test
