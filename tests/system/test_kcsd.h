// A kcsd of a test's own, as a process, and the shortest ways to talk to it.
#pragma once

#include <google/rpc/error_details.pb.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <kcs/v1/planning.grpc.pb.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/files/temporary_folder.h"
#include "tests/system/child_process.h"

namespace kcs::test {

// A call gets this long before a test calls it hung.
inline constexpr std::chrono::seconds kDeadline{60};

struct Call : grpc::ClientContext {
  Call() { set_deadline(std::chrono::system_clock::now() + kDeadline); }
};

template <typename Message>
struct Answer {
  grpc::Status status;
  Message message;
};

// On free ports of the loopback.
class TestKcsd {
 public:
  // settings: a configuration file. Throws std::runtime_error if it does not start.
  explicit TestKcsd(const std::string& settings);

  ChildProcess& process() { return process_; }
  const std::string& address() const { return address_; }
  v1::PlanningService::Stub& stub() { return *stub_; }
  // On a connection of its own.
  std::unique_ptr<v1::PlanningService::Stub> new_stub() const;

  Answer<v1::Plan> create(const std::vector<v1::CreatePlanRequest>& messages);
  Answer<v1::Plan> get(const std::string& name);
  grpc::Status remove(const std::string& name);
  // The whole list, page after page.
  Answer<std::vector<v1::Plan>> list();
  // All batches of a stream, as bytes.
  Answer<std::vector<std::string>> stream(const v1::StreamSetpointsRequest& request);
  v1::Plan wait_until_ready(const std::string& name);

  // The status of an answer over HTTP, and its text.
  struct Page {
    int status = 0;
    std::string text;
  };
  Page page(const std::string& path) const;
  // What the standard health service says of `service`; nothing if it does not answer.
  std::optional<bool> is_serving(const std::string& service = "") const;

  // The number after a word in the process's /proc/…/status, such as "Threads:" or "VmRSS:" (kB).
  std::size_t status_figure(const std::string& word) const;

 private:
  std::string config(const std::string& settings) const;

  TemporaryFolder folder_;
  ChildProcess process_;
  std::string address_;
  std::string http_address_;
  std::unique_ptr<v1::PlanningService::Stub> stub_;
};

// A mill of three axes, 100 mm/s.
v1::PlanOptions mill();
// A request of moves of 10 mm at different angles: `number` makes it another one.
std::vector<v1::CreatePlanRequest> request_of(std::uint64_t number, int moves = 20);
std::vector<v1::CreatePlanRequest> accept_only(std::vector<v1::CreatePlanRequest> messages);
v1::StreamSetpointsRequest setpoints(const std::string& name, double period);

// What a plan says of its path, without when it was accepted.
std::string content(const v1::Plan& plan);

// UNAVAILABLE, and when it is worth to try again.
::testing::AssertionResult is_unavailable_for_a_while(const grpc::Status& status);
::testing::AssertionResult tells_when_to_try_again(const grpc::Status& status);

// Waits until `condition` holds, for up to kDeadline.
bool eventually(const std::function<bool()>& condition);

}  // namespace kcs::test
