// How an operator takes the tables of the store back for an older kcsd.
#include <gmock/gmock.h>
#include <signal.h>

#include <string>

#include "tests/system/shared_store.h"
#include "tests/system/test_kcsd.h"

namespace kcs::test {
namespace {

using ::testing::HasSubstr;

template <typename Store>
class KcsdSchema : public ::testing::Test {
 protected:
  Result take_back() const { return run({KCSD, "--config", config_.path(), "--schema", "1"}); }

  Store store_;
  const ConfigFile config_{store_.settings()};
};

using Stores = ::testing::Types<SqliteStore, PostgresqlStore>;
TYPED_TEST_SUITE(KcsdSchema, Stores);

TYPED_TEST(KcsdSchema, GoesBackWhenNobodyUsesTheStoreAndForwardWithTheNextStart) {
  v1::Plan plan;
  {
    TestKcsd kcsd(this->store_.settings());
    plan = kcsd.create(request_of(1)).message;
    const Result refused = this->take_back();
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.errors, HasSubstr("stop every kcsd"));
    EXPECT_EQ(kcsd.get(plan.name()).message.SerializeAsString(), plan.SerializeAsString());
    kcsd.process().send_signal(SIGTERM);
    EXPECT_EQ(kcsd.process().wait(), 0);
  }
  Result back;  // PostgreSQL notices some time later that a server is gone
  EXPECT_TRUE(eventually([&] { return (back = this->take_back()).exit_code == 0; })) << back.errors;
  EXPECT_THAT(back.output, HasSubstr("tables were of version 3 and are of version 1\nlost: all runs of machines"));
  TestKcsd kcsd(this->store_.settings());
  EXPECT_EQ(kcsd.get(plan.name()).message.SerializeAsString(), plan.SerializeAsString());
}

}  // namespace
}  // namespace kcs::test
