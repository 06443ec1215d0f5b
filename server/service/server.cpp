#include "server/service/server.h"

#include <grpcpp/ext/channelz_service_plugin.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <future>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "server/http/plan_pages.h"
#include "server/jobs/plan_cache.h"
#include "server/jobs/plan_desk.h"
#include "server/observe/http_endpoint.h"
#include "server/service/access_control.h"
#include "server/service/archive.h"
#include "server/service/calls.h"
#include "server/service/caretaker.h"
#include "server/service/listen_address.h"
#include "server/service/machine_service.h"
#include "server/service/observation.h"
#include "server/service/planning_service.h"
#include "server/service/plans.h"
#include "server/service/socket_acceptor.h"
#include "server/service/tls_credentials.h"
#include "server/store/errors.h"
#include "server/systemd/inherited_sockets.h"

namespace kcs::service {
namespace {

// Threads for calls beside the uploads and the streams: the short ones, health, reflection.
constexpr int kSpareThreads = 64;
// How stopping goes on: how often it looks whether a call runs, how long it waits for streams to end themselves, for
// clients to read what was sent and for cancelled calls to end.
constexpr std::chrono::milliseconds kIdleCheck{20};
constexpr std::chrono::milliseconds kFarewell{200};
constexpr std::chrono::seconds kLinger{2};
constexpr std::chrono::seconds kCancellation{1};

std::size_t thread_count(std::size_t wanted) {
  return wanted > 0 ? wanted : std::max(1U, std::thread::hardware_concurrency());
}

// What the connections speak: TLS if there is a certificate.
std::shared_ptr<grpc::ServerCredentials> make_credentials(const SecuritySettings& settings) {
  if (settings.tls.certificate.empty()) return grpc::InsecureServerCredentials();
  return std::make_shared<TlsCredentials>(settings.tls);
}

jobs::Scheduler::Limits scheduling(const Caps& caps, std::size_t threads) {
  return {.threads = threads,
          .queue_length = caps.queue_length,
          .client_waiting = caps.client_waiting,
          .client_running = caps.client_running > 0 ? caps.client_running : threads};
}

grpc::ServerBuilder& configure(grpc::ServerBuilder& builder, const ServerOptions& options) {
  const Caps& caps = options.caps;
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  builder.AddChannelArgument(GRPC_ARG_ENABLE_CHANNELZ, options.observe.channelz ? 1 : 0);
  grpc::ResourceQuota quota("kcsd");
  quota.SetMaxThreads(static_cast<int>(caps.uploads + caps.streams + caps.live_streams + 2 * caps.machines) +
                      kSpareThreads);
  builder.SetResourceQuota(quota);
  builder.SetMaxReceiveMessageSize(static_cast<int>(caps.message_bytes));
  // A compressed message is measured only when it has been blown up to a thousand times its size.
  builder.SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_DEFLATE, false);
  builder.SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_GZIP, false);
  // A port that another server listens on is an error, not shared.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  apply(options.connections, builder);
  return builder;
}

// Null if nobody asks for it.
std::unique_ptr<observe::HttpEndpoint> make_http(const std::string& listen, const Observation& observation,
                                                 http::PlanPages& plans) {
  if (listen.empty()) return nullptr;
  return std::make_unique<observe::HttpEndpoint>(
      listen, observation.registry, observation.readiness, observation.log,
      observe::LatePages{.path = http::PlanPages::kPath,
                         .at_a_time = plans.at_a_time(),
                         .add = [&plans](httplib::Server& server) { plans.add_to(server); }});
}

// Over HTTP nobody is let in whom gRPC would not let in.
http::PlanPages::Options plan_pages_of(const ServerOptions& options) {
  http::PlanPages::Options pages{
      .machines = options.machines, .at_a_time = options.caps.http_plans, .answers_network = options.security.insecure};
  if (!options.security.tls.client_ca.empty()) {
    pages.closed_because = "this server asks its clients for certificates: call it over gRPC, where they can be shown";
  }
  return pages;
}

// For the first calls, which may come with the socket. If it cannot be opened now, the caretaker says why and tries
// again.
void try_open(Archive& archive) {
  try {
    archive.open();
  } catch (const store::StoreError&) {
  }
}

}  // namespace

struct Server::Parts {
  explicit Parts(const ServerOptions& options)
      : caps(options.caps),
        observation{.log = options.log},
        plan_pages(plan_pages_of(options)),
        http(make_http(options.observe.http_listen, observation, plan_pages)),
        memory(caps.cached_plans, caps.cached_bytes),
        archive(options.store, memory, observation.metrics.store_duration),
        desk(archive, scheduling(caps, thread_count(options.planning_threads)),
             [this](const jobs::PlanDesk::Planned& planned) { report(observation, planned); }),
        plans(desk, archive, caps),
        access(options.security),
        calls(access, observation),
        service(plans, caps, calls),
        machines(caps.machines),
        machine_runs(machines, plans, archive),
        machine_service(machines, machine_runs, caps, calls),
        credentials(make_credentials(options.security)) {
    add_readings(observation.registry, desk);
  }
  ~Parts() {
    http.reset();  // it reads from the desk, and calls the server
    plan_pages.open(nullptr);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  // Until no call runs, or until `end`.
  void wait_until_idle(std::chrono::steady_clock::time_point end) const {
    while (!calls.idle() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(kIdleCheck);
  }

  const Caps caps;
  Observation observation;
  http::PlanPages plan_pages;
  std::unique_ptr<observe::HttpEndpoint> http;  // null if nobody asked for it
  jobs::PlanCache memory;
  Archive archive;
  jobs::PlanDesk desk;
  std::optional<Caretaker> caretaker;  // from when it listens until it stops
  Plans plans;
  AccessControl access;
  Calls calls;
  PlanningService service;
  Machines machines;
  MachineRuns machine_runs;
  MachineService machine_service;
  std::shared_ptr<grpc::ServerCredentials> credentials;  // stay as long as the server
  std::string address;
  std::unique_ptr<grpc::Server> server;
  std::unique_ptr<SocketAcceptor> acceptor;  // null unless systemd listens
  std::mutex stopping;
  // Once it is told to stop: what is not planned yet, and the gRPC server.
  std::future<void> given_back, down;
};

Server::Server(const ServerOptions& options) {
  require_safe(options.security, options.listen);
  parts_ = std::make_unique<Parts>(options);
  try_open(parts_->archive);
  if (options.observe.channelz) grpc::channelz::experimental::InitChannelzService();  // for builders made afterwards
  grpc::ServerBuilder builder;
  configure(builder, options).RegisterService(&parts_->service).RegisterService(&parts_->machine_service);
  if (options.listen == kSystemd) {
    serve_inherited(builder);
  } else {
    serve_address(builder, options.listen);
  }
  parts_->plan_pages.open(in_process_channel());
  grpc::HealthCheckServiceInterface* const health = parts_->server->GetHealthCheckService();
  health->SetServingStatus(v1::PlanningService::service_full_name(), false);
  health->SetServingStatus(v1::MachineService::service_full_name(), false);
  parts_->observation.readiness.watch([health](bool ready) { health->SetServingStatus(ready); });
  parts_->caretaker.emplace(parts_->archive, parts_->desk, parts_->observation.readiness, parts_->caps,
                            options.store.lease);
}

void Server::serve_address(grpc::ServerBuilder& builder, const std::string& listen) {
  int port = 0;
  if (!listen.empty()) builder.AddListeningPort(listen, parts_->credentials, &port);
  parts_->server = builder.BuildAndStart();
  if (parts_->server == nullptr || (!listen.empty() && port == 0)) {
    throw std::runtime_error("cannot listen on " + listen +
                             ": is another program using it, or is it no address of this machine? Choose another one");
  }
  parts_->address =
      listen.empty() || is_unix(listen) ? listen : listen.substr(0, listen.rfind(':') + 1) + std::to_string(port);
}

void Server::serve_inherited(grpc::ServerBuilder& builder) {
  std::vector<int> sockets;
  for (const systemd::InheritedSocket& socket : systemd::inherited_sockets()) {
    parts_->address += (sockets.empty() ? "" : ",") + socket.address;
    sockets.push_back(socket.descriptor);
  }
  using Builder = std::remove_reference_t<decltype(builder.experimental())>;
  auto acceptor = builder.experimental().AddExternalConnectionAcceptor(Builder::ExternalConnectionType::FROM_FD,
                                                                       parts_->credentials);
  parts_->server = builder.BuildAndStart();
  if (parts_->server == nullptr) throw std::runtime_error("cannot serve on the sockets of systemd");
  parts_->acceptor = std::make_unique<SocketAcceptor>(std::move(sockets), std::move(acceptor));
}

Server::~Server() { stop(std::chrono::milliseconds(0)); }

const std::string& Server::address() const { return parts_->address; }

std::string Server::http_address() const { return parts_->http ? parts_->http->address() : ""; }

std::shared_ptr<grpc::Channel> Server::in_process_channel() {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);  // a plan of many notices is no threat within a process
  return parts_->server->InProcessChannel(arguments);
}

void Server::stop(std::chrono::milliseconds grace) {
  const std::lock_guard lock(parts_->stopping);
  if (parts_->down.valid()) return;
  parts_->acceptor.reset();
  parts_->observation.readiness.stop();
  parts_->server->GetHealthCheckService()->Shutdown();
  parts_->calls.close();
  const auto end = std::chrono::steady_clock::now() + grace;
  parts_->wait_until_idle(end);
  // A stream that is not yet at its end can go on elsewhere; that it must takes no time to say.
  parts_->calls.end();
  parts_->wait_until_idle(std::chrono::steady_clock::now() + kFarewell);
  parts_->given_back = std::async(std::launch::async, [caretaker = &*parts_->caretaker] { caretaker->stop(); });
  // Only now, for gRPC closes a connection together with its last call, and what the client has not yet read by then is
  // lost. Without a call it waits until the client has confirmed that it read everything; an idle or a silent one may
  // never do so.
  const std::chrono::milliseconds linger = parts_->calls.idle() ? kLinger : std::chrono::milliseconds(0);
  parts_->down = std::async(std::launch::async, [server = parts_->server.get(), linger] {
    server->Shutdown(std::chrono::system_clock::now() + linger);
  });
  const auto last = std::chrono::steady_clock::now() + linger + kCancellation;
  parts_->down.wait_until(last);
  parts_->given_back.wait_until(last);  // longer if the database does not answer
}

}  // namespace kcs::service
