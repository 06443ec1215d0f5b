// A kcsd of a test's own, as a process, and a client of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/rpc/eventually.h"
#include "tests/rpc/refusals.h"
#include "tests/rpc/requests.h"
#include "tests/rpc/test_client.h"
#include "tests/system/config_file.h"
#include "tests/system/kcsd_process.h"

namespace kcs::test {

// On free ports of the loopback.
class TestKcsd : public KcsdProcess, public TestClient {
 public:
  // settings: a configuration file. Throws std::runtime_error if it does not start.
  explicit TestKcsd(const std::string& settings);

  // The status of an answer over HTTP, and its text.
  struct Page {
    int status = 0;
    std::string text;
  };
  Page page(const std::string& path) const;
  // Where it answers over HTTP.
  const std::string& http_address() const { return http_address_; }
  // What the standard health service says of `service`; nothing if it does not answer.
  std::optional<bool> is_serving(const std::string& service = "") const;

 private:
  explicit TestKcsd(const ConfigFile& config);

  const std::string http_address_;
};

// A request of moves of 10 mm at different angles: `number` makes it another one.
std::vector<v1::CreatePlanRequest> request_of(std::uint64_t number, int moves = 20);
std::vector<v1::CreatePlanRequest> accept_only(std::vector<v1::CreatePlanRequest> messages);

}  // namespace kcs::test
