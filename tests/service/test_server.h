// A planning server on a real socket of the loopback, and a client of it.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "server/service/server.h"
#include "tests/rpc/eventually.h"
#include "tests/rpc/refusals.h"
#include "tests/rpc/requests.h"
#include "tests/rpc/test_client.h"

namespace kcs::service::test {

using kcs::test::Answer;
using kcs::test::bytes;
using kcs::test::Call;
using kcs::test::content;
using kcs::test::detail;
using kcs::test::eventually;
using kcs::test::find_detail;
using kcs::test::gcode;
using kcs::test::kDeadline;
using kcs::test::new_channel;
using kcs::test::options;
using kcs::test::path;
using kcs::test::refuses_field;
using kcs::test::request;
using kcs::test::right_angle;
using kcs::test::setpoints;
using kcs::test::TestClient;
using kcs::test::violations;
using kcs::test::zigzag;

class LoopbackServer {
 public:
  // On a free port, and with its plans in memory unless the options say otherwise.
  explicit LoopbackServer(ServerOptions options);

  Server& server() { return *server_; }
  const std::string& address() const { return server_->address(); }

 private:
  std::unique_ptr<Server> server_;
};

// The client is connected to the server, and goes before it.
class TestServer : public LoopbackServer, public TestClient {
 public:
  explicit TestServer(ServerOptions options = {});
};

// All numbers of one axis, batch after batch.
std::vector<double> column(const std::vector<v1::SetpointBatch>& batches, int axis,
                           const google::protobuf::RepeatedPtrField<v1::Column>& (v1::SetpointBatch::*channel)()
                               const = &v1::SetpointBatch::position_mm);

}  // namespace kcs::service::test
