// A machine service on a loopback socket that runs one straight motion on whichever machine comes, and misbehaves as a
// test wants it to.
#pragma once

#include <grpcpp/grpcpp.h>

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "kcs/v1/machine.grpc.pb.h"
#include "tests/unit/gateway/machine/straight_server.h"

namespace kcs::gateway {

class FakeMachineServer : public v1::MachineService::Service {
 public:
  using Stream = grpc::ServerReaderWriter<v1::AttachMachineResponse, v1::AttachMachineRequest>;

  // brain: decides what is sent. It outlives servers, as a store does.
  explicit FakeMachineServer(StraightServer& brain, int port = 0) : brain_(brain), port_(port) {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:" + std::to_string(port), grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
    if (server_ == nullptr) throw std::runtime_error("the port is taken");
  }
  // Breaks the calls off, as the end of a process does.
  ~FakeMachineServer() override { server_->Shutdown(std::chrono::system_clock::now()); }

  int port() const { return port_; }

  // Sees each order before it goes out, and may spoil it. To be set before a machine comes.
  std::function<void(v1::AttachMachineResponse&)> on_order = [](v1::AttachMachineResponse&) {};
  // What the next calls are answered, instead of being served; OK: they are served.
  void refuse(grpc::Status status) {
    const std::lock_guard lock(mutex_);
    refusal_ = std::move(status);
  }

  void hold() {
    const std::lock_guard lock(mutex_);
    const v1::AttachMachineResponse order = brain_.hold();
    if (stream_ != nullptr) stream_->Write(order);
  }
  void resume() {
    const std::lock_guard lock(mutex_);
    brain_.resume();
  }

  // Waits for a report that fulfils the condition; false if none has come in time.
  bool wait_for(const std::function<bool(const v1::MachineReport&)>& condition,
                std::chrono::milliseconds patience = std::chrono::seconds(60)) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, patience, [&] { return reports_ > 0 && condition(report_); });
  }
  v1::MachineHello hello() {
    const std::lock_guard lock(mutex_);
    return hello_;
  }
  int calls() {
    const std::lock_guard lock(mutex_);
    return calls_;
  }
  int reports() {
    const std::lock_guard lock(mutex_);
    return reports_;
  }

 private:
  grpc::Status AttachMachine(grpc::ServerContext*, Stream* stream) override {
    v1::AttachMachineRequest request;
    if (!stream->Read(&request) || !request.has_hello()) return {grpc::StatusCode::INVALID_ARGUMENT, "no hello"};
    {
      const std::lock_guard lock(mutex_);
      ++calls_;
      if (!refusal_.ok()) return refusal_;
      hello_ = request.hello();
      stream_ = stream;
      brain_.reconnect();
    }
    while (stream->Read(&request)) {
      const std::lock_guard lock(mutex_);
      report_ = request.report();
      ++reports_;
      for (v1::AttachMachineResponse& order : brain_.react(report_)) {
        on_order(order);
        stream->Write(order);
      }
      changed_.notify_all();
    }
    const std::lock_guard lock(mutex_);
    if (stream_ == stream) stream_ = nullptr;
    return grpc::Status::OK;
  }

  std::mutex mutex_;  // guards all below but the server
  std::condition_variable changed_;
  StraightServer& brain_;
  Stream* stream_ = nullptr;
  v1::MachineHello hello_;
  v1::MachineReport report_;
  grpc::Status refusal_;
  int calls_ = 0;
  int reports_ = 0;
  int port_;
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace kcs::gateway
