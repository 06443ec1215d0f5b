#include "server/observe/readiness.h"

#include <utility>

namespace kcs::observe {

void Readiness::watch(std::function<void(bool ready)> changed) {
  const std::lock_guard lock(mutex_);
  changed_ = std::move(changed);
  changed_(obstacle_.empty());
}

void Readiness::stop() {
  const std::lock_guard lock(mutex_);
  stopping_ = true;
  set_locked("the server is stopping");
}

std::string Readiness::obstacle() const {
  const std::lock_guard lock(mutex_);
  return obstacle_;
}

void Readiness::set(const std::string& obstacle) {
  const std::lock_guard lock(mutex_);
  if (!stopping_) set_locked(obstacle);
}

void Readiness::set_locked(const std::string& obstacle) {
  obstacle_ = obstacle;
  if (changed_) changed_(obstacle_.empty());
}

}  // namespace kcs::observe
