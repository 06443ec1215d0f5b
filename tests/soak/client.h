// One client: does one thing after the other, chosen at random, as long as it is told to.
#pragma once

#include <grpcpp/client_context.h>
#include <kcs/v1/planning.grpc.pb.h>

#include <chrono>
#include <memory>
#include <random>
#include <stop_token>
#include <string>

#include "tests/soak/ledger.h"
#include "tests/soak/recipe.h"
#include "tests/soak/tally.h"

namespace kcs::soak {

// A call of the server; one that hangs ends with DEADLINE_EXCEEDED. Waits where there is no server.
struct Call : grpc::ClientContext {
  explicit Call(std::chrono::milliseconds patience = std::chrono::seconds(60)) {
    set_wait_for_ready(true);
    set_deadline(std::chrono::system_clock::now() + patience);
  }
  const Clock::time_point began = Clock::now();
};

// The digest of all setpoints that a stream gives; how it ended.
struct StreamEnd {
  grpc::Status status;
  std::uint64_t digest = 0;
};
StreamEnd read_setpoints(v1::PlanningService::Stub& stub, Call& call, const std::string& plan);

// On a connection of its own. What is acknowledged goes into the ledger, how calls end into the tally, and so does what
// must not be.
class Client {
 public:
  // Keeps references to the ledger and the tally.
  Client(const std::string& address, std::uint64_t seed, Ledger& ledger, Tally& tally);

  // Until it is told to stop; the call that runs then goes on to its end.
  void work(const std::stop_token& stop);

 private:
  void create(Size size);
  void create_without_waiting(Size size);
  void create_and_give_up();
  void create_with_little_time();
  void create_nonsense();
  void create_again();
  void get();
  void watch();
  void list();
  void remove();
  void stream();
  void stream_and_give_up();
  void stream_at_pace(const std::stop_token& stop);
  void stream_slowly(const std::stop_token& stop);
  void describe_corners();
  void plan_live();

  Recipe recipe(Size size);
  grpc::Status send(Call& call, const std::vector<v1::CreatePlanRequest>& messages, v1::Plan& plan);
  // Counts what was asked of a plan that the ledger may hold: one that it does not may be gone.
  bool count(const std::string& method, const Call& call, const grpc::Status& status, const std::string& plan,
             std::initializer_list<grpc::StatusCode> expected = {});
  void compare(const v1::Plan& plan);
  int whole(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }

  std::mt19937_64 random_;
  std::unique_ptr<v1::PlanningService::Stub> stub_;
  Ledger& ledger_;
  Tally& tally_;
};

}  // namespace kcs::soak
