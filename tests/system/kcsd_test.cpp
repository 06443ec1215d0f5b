// The program kcsd: how it starts, serves, refuses to start, and stops.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <string>
#include <vector>

#include "tests/rpc/requests.h"
#include "tests/rpc/test_client.h"
#include "tests/system/config_file.h"
#include "tests/system/kcsd_process.h"

namespace kcs::test {
namespace {

std::vector<std::string> on_loopback(const std::vector<std::string>& flags) {
  std::vector<std::string> command = {KCSD, "--database", "memory", "--listen", "127.0.0.1:0"};
  command.insert(command.end(), flags.begin(), flags.end());
  return command;
}

// kcsd on a free port of the loopback, and a client of it.
class Kcsd : public KcsdProcess, public TestClient {
 public:
  explicit Kcsd(const std::vector<std::string>& flags = {})
      : KcsdProcess(on_loopback(flags)), TestClient(new_channel(address())) {}

  // A plan of 200 mm at `feed`.
  Answer<v1::Plan> create(double feed) {
    return TestClient::create({request(options()), request(path({0, 0, 100, 0, 100, 100}, feed))});
  }
};

// Runs kcsd until it ends by itself.
Result run_kcsd(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), KCSD);
  return run(arguments);
}

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
  const auto plan = kcsd.create(50);
  ASSERT_TRUE(plan.status.ok());
  EXPECT_GT(plan.message.summary().cycle_time_s(), 4);
  EXPECT_FALSE(kcsd.create(-1).status.ok());
  kcsd.process().send_signal(SIGTERM);
  EXPECT_EQ(kcsd.process().wait(), 0);
  EXPECT_EQ(kcsd.process().read_line(), "") << "more than one line on the standard output";
  const std::string log = kcsd.process().errors();
  EXPECT_NE(log.find("plan=" + plan.message.name() + " segments=2"), std::string::npos) << log;
  EXPECT_NE(log.find("CreatePlan refused: path.feed_mm_s"), std::string::npos) << log;
}

TEST(Kcsd, ShutsDownAfterTheStreamsThatRun) {
  for (const int number : {SIGTERM, SIGINT}) {
    Kcsd kcsd;
    const auto plan = kcsd.create(100);
    ASSERT_TRUE(plan.status.ok());
    Call call;
    v1::StreamSetpointsRequest request = setpoints(plan.message.name(), 1e-5);
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
  const auto plan = kcsd.create(0.01);
  ASSERT_TRUE(plan.status.ok());
  Call call;
  v1::StreamSetpointsRequest request = setpoints(plan.message.name(), 1e-5);
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
  const Result refused = run_kcsd({"--listen", first.address()});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.errors.find("cannot listen on " + first.address()), std::string::npos) << refused.errors;
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
    const Result refused = run_kcsd({"--config", config.path()});
    EXPECT_EQ(refused.exit_code, 1) << bad.text;
    EXPECT_NE(refused.errors.find(config.path() + ":" + std::to_string(bad.line) + ": "), std::string::npos)
        << refused.errors;
    EXPECT_NE(refused.errors.find(bad.hint), std::string::npos) << refused.errors;
  }
  const Result refused = run_kcsd({"--config", "/nowhere/kcsd.toml"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.errors.find("/nowhere/kcsd.toml"), std::string::npos) << refused.errors;
}

TEST(Kcsd, ExampleConfigurationSaysTheDefaults) {
  // A file with all settings that starts is one without unknown keys; flags win over it.
  Kcsd kcsd({"--config", std::string(KCS_SOURCE) + "/deploy/kcsd.toml", "--log-level", "off", "--threads", "1"});
  EXPECT_TRUE(kcsd.create(50).status.ok());
  EXPECT_EQ(kcsd.process().errors(), "");
}

TEST(Kcsd, UnknownFlagsAndBadValuesAreRefused) {
  EXPECT_NE(run_kcsd({"--lisen", "127.0.0.1:0"}).exit_code, 0);
  EXPECT_NE(run_kcsd({"--threads", "-1"}).exit_code, 0);
  const Result nowhere = run_kcsd({"--listen", "nowhere"});
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_NE(nowhere.errors.find("HOST:PORT"), std::string::npos) << nowhere.errors;
  EXPECT_EQ(run_kcsd({"--log-level", "loud"}).exit_code, 1);
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
  EXPECT_TRUE(kcsd.create(50).status.ok());
  kcsd.process().send_signal(SIGTERM);
  const auto began = std::chrono::steady_clock::now();
  EXPECT_EQ(kcsd.process().wait(), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(5)) << "they delay its end";
  for (const int connection : connections) close(connection);
}

}  // namespace
}  // namespace kcs::test
