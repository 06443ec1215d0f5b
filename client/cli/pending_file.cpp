#include "client/cli/pending_file.h"

#include <fmt/core.h>
#include <unistd.h>

#include <system_error>

namespace kcs::cli {
namespace {

namespace fs = std::filesystem;

void remove_quietly(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
}

}  // namespace

PendingFile::PendingFile(const fs::path& name) : name_(fs::exists(name) ? fs::canonical(name) : name), path_(name_) {
  if (fs::exists(name_) && !fs::is_regular_file(name_)) return;
  path_ += fmt::format(".{}.part", ::getpid());
  clean_up_.emplace([file = path_] { remove_quietly(file); });
}

PendingFile::~PendingFile() {
  if (path_ != name_) remove_quietly(path_);
}

void PendingFile::commit() {
  if (path_ == name_) return;
  fs::rename(path_, name_);
  path_ = name_;
}

}  // namespace kcs::cli
