// What tools ask for over HTTP: figures, whether the process lives, whether it takes requests.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "server/observe/log.h"
#include "server/observe/readiness.h"
#include "server/observe/registry.h"

namespace httplib {
class Server;
}

namespace kcs::observe {

// Pages beside the end point's own, which take as long as their clients wait for them: a POST to `path`, whose body may
// be of any length but must come at 64 KiB a second, and a GET of what is below it. A handler asks its request's
// progress(0, 0) whether the client still waits.
struct LatePages {
  std::string path;
  std::size_t at_a_time = 0;  // threads that they keep busy at the most; the end point has so many more
  std::function<void(httplib::Server&)> add;
};

// Answers from construction to destruction, without encryption or passwords, and says nothing secret of itself:
//   GET /metrics   the figures, for Prometheus
//   GET /healthz   200 as long as the process lives
//   GET /readyz    200 if the server takes requests, else 503 with the reason
// Each connection carries one request of up to 8 KiB and has five seconds in all, but for the late pages; eight are
// served at a time besides those, and as many wait. Whoever wants more waits before he is accepted.
class HttpEndpoint {
 public:
  // listen: "HOST:PORT"; port 0: any free one. Keeps references to `registry` and `readiness`.
  // Throws std::runtime_error, with the address and the remedy, if it cannot listen there.
  HttpEndpoint(const std::string& listen, const Registry& registry, const Readiness& readiness, const Log& log,
               const LatePages& pages = {});
  // Waits for the connections that are open: five seconds at most, and for what the late pages do.
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
