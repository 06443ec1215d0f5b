// kcsd as systemd, monitoring and collectors of logs deal with it.
#include <arpa/inet.h>
#include <grpcpp/impl/rpc_method.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/rpc/test_client.h"
#include "tests/system/config_file.h"
#include "tests/system/kcsd_process.h"
#include "tests/systemd/notify_socket.h"

namespace kcs::test {
namespace {

// Asks for a plan that is not there: the status that a serving kcsd answers is NOT_FOUND.
grpc::Status ask(const std::string& address) {
  const auto stub = v1::PlanningService::NewStub(new_channel(address));
  Call call;
  call.set_wait_for_ready(true);
  v1::GetPlanRequest request;
  request.set_name("plans/none");
  v1::Plan plan;
  return stub->GetPlan(&call, request, &plan);
}

TEST(KcsdUnderSystemd, TellsWhenItIsReadyAliveAndStopping) {
  const NotifySocket manager;
  KcsdProcess kcsd({"/usr/bin/env", "NOTIFY_SOCKET=" + manager.path(), "WATCHDOG_USEC=200000", KCSD, "--database",
                    "memory", "--listen", "127.0.0.1:0"});
  EXPECT_EQ(manager.receive(), "READY=1\nSTATUS=serves on " + kcsd.address());
  for (int i = 0; i < 3; ++i) EXPECT_EQ(manager.receive(), "WATCHDOG=1");
  kcsd.process().send_signal(SIGTERM);
  std::string last = manager.receive();
  while (last == "WATCHDOG=1") last = manager.receive();
  EXPECT_EQ(last, "STOPPING=1\nSTATUS=lets running requests finish");
  EXPECT_EQ(kcsd.process().wait(), 0);
}

// A socket of the loopback that listens, as systemd keeps it for a service across its restarts.
class ListeningSocket {
 public:
  ListeningSocket() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), size), 0);
    EXPECT_EQ(listen(socket_, SOMAXCONN), 0);
    getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    address_ = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
  }
  ~ListeningSocket() { close(socket_); }
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;

  const std::string& address() const { return address_; }

  // kcsd with this socket as its file descriptor 3, as systemd would start it.
  std::vector<std::string> command() const {
    return {"/bin/bash", "-c",
            "exec 3<&" + std::to_string(socket_) +
                "; export LISTEN_PID=$$ LISTEN_FDS=1 LISTEN_FDNAMES=kcsd.socket; exec \"$0\" --database memory "
                "--listen systemd",
            KCSD};
  }

 private:
  const int socket_ = socket(AF_INET, SOCK_STREAM, 0);  // not closed on exec
  std::string address_;
};

TEST(KcsdUnderSystemd, ServesOnASocketThatItIsHanded) {
  const ListeningSocket socket;
  KcsdProcess kcsd(socket.command());
  EXPECT_EQ(kcsd.address(), socket.address());
  for (int i = 0; i < 3; ++i) EXPECT_EQ(ask(socket.address()).error_code(), grpc::StatusCode::NOT_FOUND);
  kcsd.process().send_signal(SIGTERM);
  EXPECT_EQ(kcsd.process().wait(), 0);
}

TEST(KcsdUnderSystemd, ClientThatComesBetweenTwoServersWaitsForTheNext) {
  const ListeningSocket socket;
  {
    KcsdProcess first(socket.command());
    EXPECT_EQ(first.address(), socket.address());
    EXPECT_EQ(ask(socket.address()).error_code(), grpc::StatusCode::NOT_FOUND);
    first.process().send_signal(SIGTERM);
    EXPECT_EQ(first.process().wait(), 0);
  }
  grpc::Status answer;
  std::thread client([&] { answer = ask(socket.address()); });
  const KcsdProcess second(socket.command());
  client.join();
  EXPECT_EQ(answer.error_code(), grpc::StatusCode::NOT_FOUND) << answer.error_message();
}

TEST(KcsdUnderSystemd, SaysWhatIsMissingWithoutASocket) {
  ChildProcess kcsd({KCSD, "--database", "memory", "--listen", "systemd"});
  EXPECT_EQ(kcsd.wait(), 1);
  EXPECT_NE(kcsd.errors().find("start the program by its .socket unit"), std::string::npos) << kcsd.errors();
}

TEST(KcsdUnderMonitoring, ShowsItsFiguresAndItsState) {
  KcsdProcess kcsd({KCSD, "--database", "memory", "--listen", "127.0.0.1:0", "--http-listen", "127.0.0.1:0"});
  EXPECT_EQ(ask(kcsd.address()).error_code(), grpc::StatusCode::NOT_FOUND);
  httplib::Client client("http://" + http_address_of(kcsd.process()));
  client.set_read_timeout(kDeadline);
  for (const std::string path : {"/healthz", "/readyz"}) {
    const auto answer = client.Get(path);
    ASSERT_TRUE(answer) << path;
    EXPECT_EQ(answer->status, 200) << path;
  }
  const auto figures = client.Get("/metrics");
  ASSERT_TRUE(figures);
  EXPECT_NE(figures->body.find("\nkcs_rpcs_total{method=\"GetPlan\",code=\"NOT_FOUND\"} 1\n"), std::string::npos)
      << figures->body;
  EXPECT_NE(figures->body.find("\nprocess_resident_memory_bytes "), std::string::npos);
}

TEST(KcsdUnderMonitoring, PortInUseIsSaidPlainly) {
  const ListeningSocket taken;
  ChildProcess kcsd({KCSD, "--database", "memory", "--listen", "127.0.0.1:0", "--http-listen", taken.address()});
  EXPECT_EQ(kcsd.wait(), 1);
  EXPECT_NE(kcsd.errors().find("cannot serve HTTP on " + taken.address()), std::string::npos) << kcsd.errors();
}

TEST(KcsdLog, IsJsonLineByLineIfAskedFor) {
  KcsdProcess kcsd(
      {KCSD, "--database", "memory", "--listen", "127.0.0.1:0", "--log-format", "json", "--log-level", "debug"});
  EXPECT_EQ(ask(kcsd.address()).error_code(), grpc::StatusCode::NOT_FOUND);
  // What speaks no gRPC makes the library write lines of its own.
  httplib::Client("http://" + kcsd.address()).Get("/\"quoted\"");
  kcsd.process().send_signal(SIGTERM);
  EXPECT_EQ(kcsd.process().wait(), 0);
  std::istringstream log(kcsd.process().errors());
  int calls = 0;
  for (std::string line; std::getline(log, line);) {
    const auto fields = nlohmann::json::parse(line, nullptr, false);
    ASSERT_TRUE(fields.is_object()) << line;
    for (const char* field : {"time", "level", "message"}) EXPECT_TRUE(fields.contains(field)) << line;
    if (fields.value("method", "") == "GetPlan") {
      ++calls;
      EXPECT_EQ(fields["status"], "NOT_FOUND");
      EXPECT_EQ(fields["request_id"].get<std::string>().size(), 32U);
    }
  }
  EXPECT_EQ(calls, 1) << kcsd.process().errors();
}

TEST(KcsdChannelz, TellsWhoIsConnectedIfAskedFor) {
  const ConfigFile config("[observe]\nchannelz = true\n");
  KcsdProcess kcsd({KCSD, "--database", "memory", "--config", config.path(), "--listen", "127.0.0.1:0"});
  // In raw bytes, as its messages are in no header of the libraries.
  const auto channel = new_channel(kcsd.address());
  Call call;
  const auto stream = std::unique_ptr<grpc::ClientReaderWriter<grpc::ByteBuffer, grpc::ByteBuffer>>(
      grpc::internal::ClientReaderWriterFactory<grpc::ByteBuffer, grpc::ByteBuffer>::Create(
          channel.get(),
          grpc::internal::RpcMethod("/grpc.channelz.v1.Channelz/GetServers", grpc::internal::RpcMethod::BIDI_STREAMING),
          &call));
  const grpc::Slice nothing;
  stream->Write(grpc::ByteBuffer(&nothing, 1));
  stream->WritesDone();
  grpc::ByteBuffer answer;
  ASSERT_TRUE(stream->Read(&answer)) << stream->Finish().error_message();
  grpc::Slice bytes;
  ASSERT_TRUE(answer.DumpToSingleSlice(&bytes).ok());
  EXPECT_NE(std::string(bytes.begin(), bytes.end()).find("listener ipv4:127.0.0.1"), std::string::npos)
      << "its socket is not listed";
}

}  // namespace
}  // namespace kcs::test
