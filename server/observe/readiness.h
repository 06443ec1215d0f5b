// Whether a server takes requests, and if not, why.
#pragma once

#include <functional>
#include <mutex>
#include <string>

namespace kcs::observe {

// Not ready at first. Safe for use by many threads at once.
class Readiness {
 public:
  Readiness() = default;
  Readiness(const Readiness&) = delete;
  Readiness& operator=(const Readiness&) = delete;

  // Has `changed` called whenever it changes, and once at once. It must not call back.
  void watch(std::function<void(bool ready)> changed);

  // Without effect once it stops.
  void set_ready() { set(""); }
  // reason: a clause such as "the store is not open yet".
  void set_not_ready(const std::string& reason) { set(reason); }
  // For good.
  void stop();

  // Why it is not ready; empty if it is.
  std::string obstacle() const;

 private:
  void set(const std::string& obstacle);
  void set_locked(const std::string& obstacle);

  mutable std::mutex mutex_;
  std::string obstacle_ = "the server is starting";
  bool stopping_ = false;
  std::function<void(bool)> changed_;
};

}  // namespace kcs::observe
