#include "server/observe/http_endpoint.h"

#include <fmt/core.h>
#include <httplib.h>
#include <sys/socket.h>

#include <functional>
#include <semaphore>
#include <stdexcept>
#include <thread>
#include <utility>

#include "server/net/address.h"
#include "server/observe/exposition.h"
#include "server/observe/http_connection.h"
#include "server/version/version.h"

namespace kcs::observe {
namespace {

constexpr std::chrono::seconds kPatience{5};
constexpr std::size_t kMostRequestBytes = 8192;
constexpr std::size_t kThreads = 8;
constexpr std::size_t kWaiting = 8;
constexpr std::chrono::milliseconds kStartCheck{1};
constexpr const char* kPlainText = "text/plain; charset=utf-8";

// The library's own queue has no bound: this one keeps whoever adds to it waiting, and so the connections with the
// operating system.
class BoundedThreads final : public httplib::TaskQueue {
 public:
  explicit BoundedThreads(std::size_t threads)
      : room_(static_cast<std::ptrdiff_t>(threads + kWaiting)), threads_(threads) {}

  void enqueue(std::function<void()> task) override {
    room_.acquire();
    threads_.enqueue([this, task = std::move(task)] {
      task();
      room_.release();
    });
  }
  void shutdown() override { threads_.shutdown(); }

 private:
  std::counting_semaphore<> room_;
  httplib::ThreadPool threads_;
};

class BoundedServer final : public httplib::Server {
 public:
  explicit BoundedServer(const LatePages& pages) : late_path_(pages.path) {
    const std::size_t threads = kThreads + pages.at_a_time;
    new_task_queue = [threads] { return std::make_unique<BoundedThreads>(threads).release(); };
    // Unlike the library's own choice this does not share a port that another server listens on.
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    });
  }

 private:
  bool process_and_close_socket(socket_t socket) override {
    HttpConnection connection(socket, kPatience, kMostRequestBytes);
    bool closed = false;
    try {
      return process_request(connection, true, closed, [&](httplib::Request& request) { set_up(request, connection); });
    } catch (...) {
      return false;  // whatever the library cannot take ends this connection, not the program
    }
  }

  void set_up(httplib::Request& request, HttpConnection& connection) const {
    if (late_path_.empty()) return;
    const bool has_body = request.method == "POST" && request.path == late_path_;
    if (!has_body && (request.method != "GET" || !request.path.starts_with(late_path_ + "/"))) return;
    connection.allow_late_answer();
    if (has_body) connection.allow_body();
    request.progress = [&connection](std::uint64_t, std::uint64_t) { return connection.client_waits(); };
  }

  const std::string late_path_;
};

}  // namespace

struct HttpEndpoint::Parts {
  explicit Parts(const LatePages& pages) : server(pages) {}
  BoundedServer server;
  std::string address;
  std::thread thread;
};

HttpEndpoint::HttpEndpoint(const std::string& listen, const Registry& registry, const Readiness& readiness,
                           const Log& log, const LatePages& pages)
    : parts_(std::make_unique<Parts>(pages)) {
  BoundedServer& server = parts_->server;
  server.Get("/metrics", [&registry](const httplib::Request&, httplib::Response& response) {
    response.set_content(registry.exposition(), kExpositionContentType);
  });
  server.Get("/healthz", [](const httplib::Request&, httplib::Response& response) {
    response.set_content(fmt::format("alive\nversion {}\nbuild {}\n", version(), build()), kPlainText);
  });
  server.Get("/readyz", [&readiness](const httplib::Request&, httplib::Response& response) {
    const std::string obstacle = readiness.obstacle();
    response.status = obstacle.empty() ? 200 : 503;
    response.set_content(obstacle.empty() ? "ready\n" : "not ready: " + obstacle + "\n", kPlainText);
  });
  if (pages.add) pages.add(server);
  server.set_logger([log](const httplib::Request& request, const httplib::Response& response) {
    log.write(spdlog::level::debug, "HTTP request answered",
              {{"method", request.method},
               {"path", request.path},
               {"status", response.status},
               {"peer", request.remote_addr}});
  });

  const auto wanted = net::parse_host_port(listen);
  if (!wanted) throw std::runtime_error("cannot serve HTTP on \"" + listen + "\": give HOST:PORT");
  int port = wanted->port;
  if (port == 0) {
    port = server.bind_to_any_port(wanted->host);
  } else if (!server.bind_to_port(wanted->host, port)) {
    port = -1;
  }
  if (port < 0) {
    throw std::runtime_error("cannot serve HTTP on " + listen +
                             ": is another program using it, or is it no address of this machine? Choose another one");
  }
  parts_->address = net::to_string({wanted->host, port});
  parts_->thread = std::thread([&server] { server.listen_after_bind(); });
  while (!server.is_running()) std::this_thread::sleep_for(kStartCheck);  // before that, stop() would be lost
}

HttpEndpoint::~HttpEndpoint() {
  parts_->server.stop();
  parts_->thread.join();
}

const std::string& HttpEndpoint::address() const { return parts_->address; }

}  // namespace kcs::observe
