// A file that appears under its name only when it is complete.
#pragma once

#include <filesystem>
#include <optional>

#include "client/cli/clean_up_on_signal.h"

namespace kcs::cli {

// Stands for a temporary file beside the final one. commit() gives it the final name in one step, replacing what was
// there; if it never comes to that, because something fails or a signal such as Ctrl-C ends the process, the temporary
// file is removed. What is not an ordinary file (/dev/null, a pipe) is written in place.
// Make it before other threads are started (CleanUpOnSignal says why).
class PendingFile {
 public:
  // The final name.
  explicit PendingFile(const std::filesystem::path& name);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  // Where to write.
  const std::filesystem::path& path() const { return path_; }

  // Call it when everything is written and closed. Throws std::filesystem::filesystem_error.
  void commit();

 private:
  std::filesystem::path name_;
  std::filesystem::path path_;
  std::optional<CleanUpOnSignal> clean_up_;  // none if the file is written in place
};

}  // namespace kcs::cli
