// What tools ask for over HTTP: figures, whether the process lives, whether it takes requests.
#pragma once

#include <memory>
#include <string>

#include "server/observe/log.h"
#include "server/observe/readiness.h"
#include "server/observe/registry.h"

namespace kcs::observe {

// Answers from construction to destruction, without encryption or passwords, and says nothing secret:
//   GET /metrics   the figures, for Prometheus
//   GET /healthz   200 as long as the process lives
//   GET /readyz    200 if the server takes requests, else 503 with the reason
// Each connection carries one request of up to 8 KiB and has five seconds in all; eight are served at a time, and as
// many wait. Whoever wants more waits before he is accepted.
class HttpEndpoint {
 public:
  // listen: "HOST:PORT"; port 0: any free one. Keeps references to `registry` and `readiness`.
  // Throws std::runtime_error, with the address and the remedy, if it cannot listen there.
  HttpEndpoint(const std::string& listen, const Registry& registry, const Readiness& readiness, const Log& log);
  // Waits for the connections that are open: five seconds at most.
  ~HttpEndpoint();
  HttpEndpoint(const HttpEndpoint&) = delete;
  HttpEndpoint& operator=(const HttpEndpoint&) = delete;

  // Where it is reached, with the port that was really taken.
  const std::string& address() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace kcs::observe
