// The gateway of a machine that exists only in the test: plays what it is sent, tick by tick, when it is told to.
#pragma once

#include <grpcpp/grpcpp.h>
#include <kcs/v1/machine.grpc.pb.h>

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/motion/limits.h"
#include "tests/motion/drives.h"
#include "tests/rpc/test_client.h"

namespace kcs::service::test {

// A run, as the machine knows it. It outlives the connection.
struct TestMachine {
  explicit TestMachine(const motion::AxisLimits& machine_limits, const motion::Vector& start = motion::Vector::Zero());

  v1::MachineHello hello;
  v1::MachineReport report;
  std::deque<v1::MotionBatch> held;  // not yet played
  v1::MotionBatch playing;           // the last one that was played
  motion::AxisLimits limits;
  kcs::test::Drives drives;  // judges what is played
  std::vector<motion::Vector> played;
  std::vector<v1::MarkerAt> switched;  // with the tick at which it came out
};

class TestGateway {
 public:
  // Attaches the machine. Both must outlive it.
  TestGateway(TestMachine& machine, const std::shared_ptr<grpc::Channel>& channel);
  // Breaks the connection.
  ~TestGateway();
  TestGateway(const TestGateway&) = delete;
  TestGateway& operator=(const TestGateway&) = delete;

  // Plays one batch, or its tail if there is no next one or a stop was asked for; waits for it first. False at the end
  // of the path, and when it stands.
  bool play();
  // From now on the server's commands are lost.
  void deafen();
  // Reports what it stands at until a command comes. False if none does.
  bool is_told_to_stop();
  // Says no more. How often the server gave a sign of life before it ended the call.
  int signs_of_life();
  // The end of the connection, as the server gives it.
  grpc::Status finish();

 private:
  void read();
  void take(const v1::AttachMachineResponse& response);
  void send_report();
  void report_until(const bool& done, std::unique_lock<std::mutex>& lock);
  void play(const google::protobuf::RepeatedPtrField<v1::Column>& columns);
  void stop();
  void update_position();

  TestMachine& machine_;
  kcs::test::Call call_;
  std::unique_ptr<v1::MachineService::Stub> stub_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::AttachMachineRequest, v1::AttachMachineResponse>> stream_;
  std::mutex mutex_;
  std::condition_variable came_;
  int signs_of_life_ = 0;
  bool stop_asked_ = false, deaf_ = false, closed_ = false, finished_ = false;
  std::thread reader_;
};

}  // namespace kcs::service::test
