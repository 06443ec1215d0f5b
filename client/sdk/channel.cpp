#include "client/sdk/channel.h"

#include <fmt/core.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>

#include <string>

#include "client/sdk/error.h"
#include "client/sdk/text_file.h"
#include "client/sdk/token_credentials.h"

namespace kcs::client {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error("INVALID_ARGUMENT", what); }

bool is_unix(const std::string& address) { return address.starts_with("unix:"); }

// What is safe is tried again, by gRPC itself, unless an answer has begun: asked twice, each of these answers as if it
// had been asked once. A plan's name is made from its request, so that this holds for CreatePlan, too. The codes are
// those of is_lost(); what the caller cancels is never tried again.
constexpr const char* kServiceConfig = R"({"methodConfig": [{
  "name": [{"service": "kcs.v1.PlanningService", "method": "CreatePlan"},
           {"service": "kcs.v1.PlanningService", "method": "GetPlan"},
           {"service": "kcs.v1.PlanningService", "method": "ListPlans"},
           {"service": "kcs.v1.PlanningService", "method": "WatchPlan"},
           {"service": "kcs.v1.PlanningService", "method": "StreamSetpoints"},
           {"service": "kcs.v1.PlanningService", "method": "DescribeCorners"},
           {"service": "kcs.v1.MachineService", "method": "ListMachines"},
           {"service": "kcs.v1.MachineService", "method": "GetRun"},
           {"service": "kcs.v1.MachineService", "method": "WatchRun"}],
  "retryPolicy": {"maxAttempts": 4, "initialBackoff": "0.2s", "maxBackoff": "2s", "backoffMultiplier": 3,
                  "retryableStatusCodes": ["UNAVAILABLE", "CANCELLED", "UNKNOWN"]}}]})";
// Of a request that is tried again: what is longer is sent once. A program of a million lines.
constexpr int kKeptRequestBytes = 64 << 20;

// What gRPC, too, takes for this machine.
bool is_loopback(const std::string& address) {
  const std::string host = address.substr(0, address.rfind(':'));
  return host == "localhost" || host == "127.0.0.1" || host == "[::1]";
}

std::string read_pem(const std::filesystem::path& file) {
  if (file.empty()) return "";
  std::string text = read_text_file(file);
  if (text.find("-----BEGIN ") == std::string::npos) refuse(fmt::format("{}: is no PEM file", file.string()));
  return text;
}

std::shared_ptr<grpc::ChannelCredentials> tls_credentials(const Connection& connection) {
  if (connection.certificate_file.empty() != connection.key_file.empty()) {
    refuse("a client's certificate and its key go together: give both, or neither");
  }
  return grpc::SslCredentials({.pem_root_certs = read_pem(connection.ca_file),
                               .pem_private_key = read_pem(connection.key_file),
                               .pem_cert_chain = read_pem(connection.certificate_file)});
}

// gRPC sends a token over no plain connection, but over one of these: they exist on this machine alone.
std::shared_ptr<grpc::ChannelCredentials> local_credentials(const Connection& connection) {
  if (is_unix(connection.address)) return grpc::experimental::LocalCredentials(UDS);
  if (is_loopback(connection.address)) return grpc::experimental::LocalCredentials(LOCAL_TCP);
  refuse(fmt::format("without TLS everybody on the way to {} could read the token: use TLS, or send none",
                     connection.address));
}

std::shared_ptr<grpc::ChannelCredentials> credentials(const Connection& connection) {
  if (connection.token_file.empty()) {
    return connection.tls ? tls_credentials(connection) : grpc::InsecureChannelCredentials();
  }
  return grpc::CompositeChannelCredentials(connection.tls ? tls_credentials(connection) : local_credentials(connection),
                                           token_credentials(connection.token_file, connection.tls));
}

}  // namespace

std::shared_ptr<grpc::Channel> open_channel(const Connection& connection, const ChannelPace& pace) {
  grpc::ChannelArguments arguments;
  const auto set = [&arguments](const std::string& name, std::chrono::milliseconds value) {
    arguments.SetInt(name, static_cast<int>(value.count()));
  };
  set(GRPC_ARG_KEEPALIVE_TIME_MS, pace.ping_after_silence);
  set(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, pace.ping_timeout);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);  // any number of them
  // A new channel is a new connection: one that is not to be trusted any more can be left.
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  if (connection.tries_again) arguments.SetServiceConfigJSON(kServiceConfig);
  arguments.SetInt(GRPC_ARG_PER_RPC_RETRY_BUFFER_SIZE, kKeptRequestBytes);
  set(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, pace.first_pause);
  set(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, pace.longest_pause);
  return grpc::CreateCustomChannel(connection.address, credentials(connection), arguments);
}

}  // namespace kcs::client
