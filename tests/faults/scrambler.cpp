#include "tests/faults/scrambler.h"

#include <stdexcept>
#include <thread>
#include <utility>

#include "client/gateway/machine/batch_check.h"

namespace kcs::faults {
namespace {

void change(v1::MotionBatch& batch, const Trick& trick) {
  const int setpoints = batch.position_mm(0).values_size();
  const int tail = batch.tail_mm().empty() ? 0 : batch.tail_mm(0).values_size();
  const int row = static_cast<int>(trick.place * (setpoints + tail - 1));
  v1::Column& column = row < setpoints ? *batch.mutable_position_mm(0) : *batch.mutable_tail_mm(0);
  const int place = row < setpoints ? row : row - setpoints;
  column.set_values(place, column.values(place) + trick.change_mm);
  if (trick.kind == Trick::kForge) batch.set_checksum(gateway::checksum_of(batch));
}

}  // namespace

Scrambler::Scrambler(const std::string& server)
    : stub_(v1::MachineService::NewStub(grpc::CreateChannel(server, grpc::InsecureChannelCredentials()))) {
  grpc::ServerBuilder builder;
  builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
  builder.RegisterService(this);
  server_ = builder.BuildAndStart();
  if (!server_) throw std::runtime_error("there is no port for the scrambler");
}

Scrambler::~Scrambler() { server_->Shutdown(std::chrono::system_clock::now()); }

void Scrambler::play(const Trick& trick) {
  const std::lock_guard lock(mutex_);
  trick_ = trick;
}

std::optional<Trick> Scrambler::take_trick() {
  const std::lock_guard lock(mutex_);
  return std::exchange(trick_, std::nullopt);
}

grpc::Status Scrambler::AttachMachine(grpc::ServerContext* context, Stream* gateway) {
  const auto call = grpc::ClientContext::FromServerContext(*context);
  const auto server = stub_->AttachMachine(call.get());
  // Ends with the gateway's next message, at the latest, if the server has ended the call.
  std::jthread reports([&] {
    v1::AttachMachineRequest message;
    while (gateway->Read(&message) && server->Write(message)) {
    }
    server->WritesDone();
  });
  v1::AttachMachineResponse order;
  std::optional<v1::AttachMachineResponse> swapped;
  while (server->Read(&order)) {
    const auto trick = order.has_batch() ? take_trick() : std::nullopt;
    if (trick && trick->kind == Trick::kSwap) {
      swapped = std::move(order);
      continue;
    }
    if (trick && trick->kind == Trick::kLose) continue;
    if (trick && trick->kind == Trick::kRepeat) gateway->Write(order);
    if (trick && trick->kind == Trick::kDelay) std::this_thread::sleep_for(trick->delay);
    if (trick && (trick->kind == Trick::kCorrupt || trick->kind == Trick::kForge))
      change(*order.mutable_batch(), *trick);
    gateway->Write(order);
    if (order.has_batch() && swapped) gateway->Write(*std::exchange(swapped, std::nullopt));
  }
  reports.join();
  return server->Finish();
}

}  // namespace kcs::faults
