#include <fmt/format.h>
#include <signal.h>

#include <stdexcept>
#include <thread>

#include "tests/faults/service.h"
#include "tests/files/temporary_folder.h"
#include "tests/system/kcsd_process.h"

namespace kcs::faults {
namespace {

class OneServer : public Service {
 public:
  OneServer() { start(); }

  const std::string& address() const override { return listen_; }

  void kill_and_restart(std::chrono::milliseconds down) override {
    end(SIGKILL);
    std::this_thread::sleep_for(down);
    start();
  }

  void drain_and_restart(std::chrono::milliseconds down) override {
    if (const int code = end(SIGTERM); code != 0) throw std::runtime_error(fmt::format("kcsd ended with {}", code));
    std::this_thread::sleep_for(down);
    start();
  }

  void exchange_another() override { throw std::logic_error("there is no other server"); }

  void pause(bool paused) override { server_->process().send_signal(paused ? SIGSTOP : SIGCONT); }

  double cpu_seconds() const override { return server_->cpu_seconds(); }

 private:
  int end(int signal) {
    server_->process().send_signal(signal);
    return server_->process().wait();
  }

  void start() {
    server_ = std::make_unique<test::KcsdProcess>(std::vector<std::string>{
        KCSD, "--listen", listen_, "--database", "sqlite:" + (folder_.path() / "plans.db").string()});
    listen_ = server_->address();
  }

  test::TemporaryFolder folder_;
  std::string listen_ = "127.0.0.1:0";
  std::unique_ptr<test::KcsdProcess> server_;
};

}  // namespace

std::unique_ptr<Service> one_server() { return std::make_unique<OneServer>(); }

}  // namespace kcs::faults
