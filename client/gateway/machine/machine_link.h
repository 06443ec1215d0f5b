// The gateway's call to the server.
#pragma once

#include <grpcpp/channel.h>
#include <spdlog/logger.h>

#include <chrono>
#include <memory>
#include <stop_token>
#include <string>

#include "client/gateway/machine/feeder.h"
#include "client/sdk/connection.h"
#include "kcs/v1/machine.grpc.pb.h"

namespace kcs::gateway {

// Holds an AttachMachine call open: hands the server's orders to the feeder, and reports to the server while a run is
// on every hello.report_s, else every 0.2 s, and whenever something has changed. A call that breaks off is made again
// for as long as it takes, after 50 ms at first and 1 s at most; one that the server refuses (the machine is attached
// already, the token is not known) after 2 s, since that mends itself only slowly.
//
// A server that says nothing for 3 s is taken for gone, however sound the connection to it looks; the next attempt
// makes another one. What the machine plays does not hang on that: without batches it stops by itself.
class MachineLink {
 public:
  // feeder must outlive this object. Throws as client::open_channel.
  MachineLink(const client::Connection& server, v1::MachineHello hello, Feeder& feeder,
              std::shared_ptr<spdlog::logger> log);

  // Returns soon after a stop is asked for.
  void run(const std::stop_token& stop);

 private:
  struct Attempt {
    grpc::Status status;
    bool attached = false;  // the server took the machine
  };

  Attempt attach(const std::stop_token& stop);
  void tell_attached();
  void tell_lost(const Attempt& attempt);

  client::Connection server_;
  v1::MachineHello hello_;
  Feeder& feeder_;
  std::shared_ptr<spdlog::logger> log_;
  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<v1::MachineService::Stub> stub_;
  std::string told_;  // the last failure that was logged: the same one again is not
};

}  // namespace kcs::gateway
