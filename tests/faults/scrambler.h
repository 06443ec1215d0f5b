// Between a gateway and a server: passes on what they say to each other, but for batches that it was told to scramble.
#pragma once

#include <grpcpp/grpcpp.h>
#include <kcs/v1/machine.grpc.pb.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace kcs::faults {

// What becomes of one batch.
struct Trick {
  enum Kind {
    kRepeat,   // it comes twice
    kSwap,     // it comes after the one that follows it
    kLose,     // it does not come
    kDelay,    // it comes later, and so does all that follows
    kCorrupt,  // a number of it is changed, but not its checksum
    kForge     // and its checksum, too
  };
  Kind kind;
  std::chrono::milliseconds delay{};  // kDelay
  double place = 0, change_mm = 0;    // which setpoint, of the batch and its tail, 0 to 1; by how much
};

class Scrambler : public v1::MachineService::Service {
 public:
  // Throws std::runtime_error if there is no port.
  explicit Scrambler(const std::string& server);
  ~Scrambler() override;

  // Where gateways reach the server through it.
  int port() const { return port_; }

  // To the batch that comes next.
  void play(const Trick& trick);

 private:
  using Stream = grpc::ServerReaderWriter<v1::AttachMachineResponse, v1::AttachMachineRequest>;

  grpc::Status AttachMachine(grpc::ServerContext* context, Stream* gateway) override;
  std::optional<Trick> take_trick();

  std::unique_ptr<v1::MachineService::Stub> stub_;
  int port_ = 0;
  std::mutex mutex_;
  std::optional<Trick> trick_;            // guarded by mutex_
  std::unique_ptr<grpc::Server> server_;  // last: it uses all the others
};

}  // namespace kcs::faults
