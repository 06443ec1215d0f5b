// The program kcsd: how it starts, serves, refuses to start, and stops.
#include <arpa/inet.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <kcs/v1/planning.grpc.pb.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tests/system/child_process.h"

namespace kcs::test {
namespace {

constexpr std::string_view kGreeting = "kcsd listens on ";

// kcsd on a free port of the loopback, and a client of it.
class Kcsd {
 public:
  explicit Kcsd(const std::vector<std::string>& flags = {}) : process_(command(flags)) {
    const std::string greeting = process_.read_line();
    if (!greeting.starts_with(kGreeting))
      throw std::runtime_error("kcsd said \"" + greeting + "\"" + process_.errors());
    address_ = greeting.substr(kGreeting.size());
    stub_ = v1::PlanningService::NewStub(grpc::CreateChannel(address_, grpc::InsecureChannelCredentials()));
  }

  ChildProcess& process() { return process_; }
  const std::string& address() const { return address_; }
  v1::PlanningService::Stub& stub() { return *stub_; }

  // A plan of 200 mm at `feed`.
  grpc::Status create(double feed, v1::Plan& plan) {
    grpc::ClientContext call;
    const auto writer = stub_->CreatePlan(&call, &plan);
    v1::CreatePlanRequest message;
    v1::Machine& machine = *message.mutable_options()->mutable_machine();
    machine.set_axes(2);
    machine.mutable_velocity_mm_s()->Resize(2, 100);
    machine.mutable_acceleration_mm_s2()->Resize(2, 2500);
    machine.mutable_jerk_mm_s3()->Resize(2, 2e5);
    writer->Write(message);
    for (const double number : {0, 0, 100, 0, 100, 100}) message.mutable_path()->add_points_mm(number);
    message.mutable_path()->add_feed_mm_s(feed);
    writer->Write(message);
    writer->WritesDone();
    return writer->Finish();
  }

  static std::vector<std::string> command(const std::vector<std::string>& flags) {
    std::vector<std::string> command = {KCSD, "--database", "memory", "--listen", "127.0.0.1:0"};
    command.insert(command.end(), flags.begin(), flags.end());
    return command;
  }

 private:
  ChildProcess process_;
  std::string address_;
  std::unique_ptr<v1::PlanningService::Stub> stub_;
};

// Runs kcsd until it ends by itself: its exit code, and in `errors` what it said.
int run(const std::vector<std::string>& arguments, std::string& errors) {
  std::vector<std::string> command = {KCSD};
  command.insert(command.end(), arguments.begin(), arguments.end());
  ChildProcess process(command);
  const int code = process.wait();
  errors = process.errors();
  return code;
}

class ConfigFile {
 public:
  explicit ConfigFile(const std::string& text)
      : path_(::testing::TempDir() + "kcsd-" + std::to_string(getpid()) + ".toml") {
    std::ofstream(path_) << text;
  }
  ~ConfigFile() { unlink(path_.c_str()); }
  ConfigFile(const ConfigFile&) = delete;
  ConfigFile& operator=(const ConfigFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

int connect_to(const std::string& address) {
  sockaddr_in target{};
  target.sin_family = AF_INET;
  target.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
  target.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int connection = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  EXPECT_EQ(connect(connection, reinterpret_cast<const sockaddr*>(&target), sizeof(target)), 0);
  return connection;
}

TEST(Kcsd, ServesAndLogsEachPlanOnOneLine) {
  Kcsd kcsd;
  v1::Plan plan;
  ASSERT_TRUE(kcsd.create(50, plan).ok());
  EXPECT_GT(plan.summary().cycle_time_s(), 4);
  EXPECT_FALSE(kcsd.create(-1, plan).ok());
  kcsd.process().send_signal(SIGTERM);
  EXPECT_EQ(kcsd.process().wait(), 0);
  EXPECT_EQ(kcsd.process().read_line(), "") << "more than one line on the standard output";
  const std::string log = kcsd.process().errors();
  EXPECT_NE(log.find("plan=" + plan.name() + " segments=2"), std::string::npos) << log;
  EXPECT_NE(log.find("CreatePlan refused: path.feed_mm_s"), std::string::npos) << log;
}

TEST(Kcsd, ShutsDownAfterTheStreamsThatRun) {
  for (const int number : {SIGTERM, SIGINT}) {
    Kcsd kcsd;
    v1::Plan plan;
    ASSERT_TRUE(kcsd.create(100, plan).ok());
    grpc::ClientContext call;
    v1::StreamSetpointsRequest request;
    request.set_name(plan.name());
    request.set_period_s(1e-5);
    request.set_batch_size(64);
    const auto reader = kcsd.stub().StreamSetpoints(&call, request);
    v1::SetpointBatch batch;
    ASSERT_TRUE(reader->Read(&batch));
    kcsd.process().send_signal(number);
    std::uint64_t count = 64;
    while (reader->Read(&batch)) count += static_cast<std::uint64_t>(batch.position_mm(0).values_size());
    EXPECT_TRUE(reader->Finish().ok());
    EXPECT_EQ(count, batch.setpoint_count());
    EXPECT_EQ(kcsd.process().wait(), 0) << kcsd.process().errors();
  }
}

TEST(Kcsd, CancelsWhatOutlastsTheGrace) {
  const ConfigFile config("[server]\ngrace_s = 0.1\n");
  Kcsd kcsd({"--config", config.path()});
  v1::Plan plan;
  ASSERT_TRUE(kcsd.create(0.01, plan).ok());
  grpc::ClientContext call;
  v1::StreamSetpointsRequest request;
  request.set_name(plan.name());
  request.set_period_s(1e-5);
  const auto reader = kcsd.stub().StreamSetpoints(&call, request);
  v1::SetpointBatch batch;
  ASSERT_TRUE(reader->Read(&batch));
  kcsd.process().send_signal(SIGTERM);
  // This client takes nothing meanwhile.
  const auto began = std::chrono::steady_clock::now();
  EXPECT_EQ(kcsd.process().wait(), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(5));
  while (reader->Read(&batch)) continue;
  EXPECT_FALSE(reader->Finish().ok());
}

TEST(Kcsd, PortInUseIsSaidPlainly) {
  const Kcsd first;
  std::string errors;
  EXPECT_EQ(run({"--listen", first.address()}, errors), 1);
  EXPECT_NE(errors.find("cannot listen on " + first.address()), std::string::npos) << errors;
}

TEST(Kcsd, ConfigurationIsRefusedWithFileAndLine) {
  struct Bad {
    const char* text;
    int line;
    const char* hint;
  };
  for (const Bad& bad :
       {Bad{"[server]\nlisten = \"127.0.0.1:0\"\nthread = 2\n", 3, "threads"}, Bad{"\n[sever]\n", 2, "server"},
        Bad{"[caps]\n\nstreams = 0\n", 3, "from 1"}, Bad{"[caps]\nstreams = \"many\"\n", 2, "whole number"},
        Bad{"[server]\nlog_level = \"loud\"\n", 2, "warning"}, Bad{"[server]\ngrace_s = -1\n", 2, "seconds"},
        Bad{"server = 1\n", 1, "table"}, Bad{"[server]\nlisten = 127.0.0.1\n", 2, ""}}) {
    const ConfigFile config(bad.text);
    std::string errors;
    EXPECT_EQ(run({"--config", config.path()}, errors), 1) << bad.text;
    EXPECT_NE(errors.find(config.path() + ":" + std::to_string(bad.line) + ": "), std::string::npos) << errors;
    EXPECT_NE(errors.find(bad.hint), std::string::npos) << errors;
  }
  std::string errors;
  EXPECT_EQ(run({"--config", "/nowhere/kcsd.toml"}, errors), 1);
  EXPECT_NE(errors.find("/nowhere/kcsd.toml"), std::string::npos) << errors;
}

TEST(Kcsd, ExampleConfigurationSaysTheDefaults) {
  // A file with all settings that starts is one without unknown keys; flags win over it.
  Kcsd kcsd({"--config", std::string(KCS_SOURCE) + "/deploy/kcsd.toml", "--log-level", "off", "--threads", "1"});
  v1::Plan plan;
  EXPECT_TRUE(kcsd.create(50, plan).ok());
  EXPECT_EQ(kcsd.process().errors(), "");
}

TEST(Kcsd, UnknownFlagsAndBadValuesAreRefused) {
  std::string errors;
  EXPECT_NE(run({"--lisen", "127.0.0.1:0"}, errors), 0);
  EXPECT_NE(run({"--threads", "-1"}, errors), 0);
  EXPECT_EQ(run({"--listen", "nowhere"}, errors), 1);
  EXPECT_NE(errors.find("HOST:PORT"), std::string::npos) << errors;
  EXPECT_EQ(run({"--log-level", "loud"}, errors), 1);
}

TEST(Kcsd, TellsItsVersion) {
  ChildProcess process({KCSD, "--version"});
  EXPECT_TRUE(process.read_line().starts_with("kcsd "));
  EXPECT_EQ(process.wait(), 0);
}

TEST(Kcsd, IsNotDisturbedByConnectionsThatSpeakNoGrpc) {
  Kcsd kcsd;
  std::vector<int> connections;
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    connections.push_back(connect_to(kcsd.address()));
    std::string bytes;
    if (i % 3 == 1) bytes = "GET / HTTP/1.1\r\nHost: kcs\r\n\r\n";
    if (i % 3 == 2) {
      bytes = i % 2 == 0 ? "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" : "";
      for (int k = 0; k < 1000; ++k) bytes.push_back(static_cast<char>(random()));
    }
    send(connections.back(), bytes.data(), bytes.size(), MSG_NOSIGNAL);  // a third stays silent
  }
  v1::Plan plan;
  EXPECT_TRUE(kcsd.create(50, plan).ok());
  kcsd.process().send_signal(SIGTERM);
  const auto began = std::chrono::steady_clock::now();
  EXPECT_EQ(kcsd.process().wait(), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(5)) << "they delay its end";
  for (const int connection : connections) close(connection);
}

}  // namespace
}  // namespace kcs::test
