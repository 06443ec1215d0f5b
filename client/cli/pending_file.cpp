#include "client/cli/pending_file.h"

#include <fmt/core.h>
#include <unistd.h>

#include <system_error>

namespace kcs::cli {

namespace fs = std::filesystem;

PendingFile::PendingFile(const fs::path& name) : name_(fs::exists(name) ? fs::canonical(name) : name), path_(name_) {
  if (!fs::exists(name_) || fs::is_regular_file(name_)) path_ += fmt::format(".{}.part", ::getpid());
}

PendingFile::~PendingFile() {
  std::error_code ignored;
  if (path_ != name_) fs::remove(path_, ignored);
}

void PendingFile::commit() {
  if (path_ == name_) return;
  fs::rename(path_, name_);
  path_ = name_;
}

}  // namespace kcs::cli
