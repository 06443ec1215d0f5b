#include "tests/system/hal_machine.h"

#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "client/gateway/player/player.h"

namespace kcs::test {
namespace {

namespace fs = std::filesystem;

const fs::path kModules = "/usr/lib/linuxcnc/modules";
const std::string kUser = "20001";  // any that nobody has

// The sampler takes the commands in millionths, for it is printed with six decimals. It keeps a minute: what prints it
// may wait for a busy disk. It begins when all is connected: the thread runs already.
constexpr double kUnit = 1e-6;
constexpr const char* kRecord = R"(loadrt sampler depth=60000 cfg=fffsu
loadrt scale names=x-scale,y-scale,z-scale
addf x-scale servo-thread
addf y-scale servo-thread
addf z-scale servo-thread
setp x-scale.gain 1e6
setp y-scale.gain 1e6
setp z-scale.gain 1e6
net x-position x-scale.in
net y-position y-scale.in
net z-position z-scale.in
net x-sample x-scale.out => sampler.0.pin.0
net y-sample y-scale.out => sampler.0.pin.1
net z-sample z-scale.out => sampler.0.pin.2
net state kcs-player.state => sampler.0.pin.3
net ticks kcs-player.ticks => sampler.0.pin.4
addf sampler.0 servo-thread
)";

// With all that HAL's user needs, who may not be allowed to enter the folder of the sources.
std::string make_folder() {
  std::string folder = "/tmp/kcs-hal-XXXXXX";
  if (!mkdtemp(folder.data())) throw std::runtime_error("no folder for HAL");
  fs::permissions(folder, fs::perms::all);
  fs::create_directory(folder + "/modules");
  for (const char* module : {"hal_lib.so", "threads.so", "sampler.so", "scale.so"}) {
    fs::copy_file(kModules / module, folder + "/modules/" + module);
  }
  fs::copy_file(KCS_HAL_MODULE, folder + "/modules/kcs_player.so");
  fs::copy_file(KCS_HAL_FEEDER, folder + "/feeder");
  fs::copy_file(KCS_SOURCE "/client/gateway/hal/simulation.hal", folder + "/machine.hal");
  fs::copy_file(KCS_SOURCE "/tests/system/hal_machine.sh", folder + "/run");
  std::ofstream(folder + "/record.hal") << kRecord;
  return folder;
}

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// The sampler writes in blocks, so that the last line may not be whole yet.
std::vector<HalSample> read_samples(const std::string& file) {
  const std::string text = text_of(file);
  std::istringstream lines(text.substr(0, text.rfind('\n') + 1));
  std::vector<HalSample> samples;
  for (HalSample sample{};
       lines >> sample.command_mm[0] >> sample.command_mm[1] >> sample.command_mm[2] >> sample.state >> sample.tick;) {
    for (double& command : sample.command_mm) command *= kUnit;
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace

std::optional<std::string> HalMachine::missing() {
  if (std::string(KCS_HAL_MODULE).empty()) return "the component is not built: linuxcnc-uspace-dev is not installed";
  if (!fs::exists("/usr/bin/halcmd")) return "linuxcnc-uspace is not installed";
  if (geteuid() != 0) return "only root can give HAL namespaces of its own";
  return std::nullopt;
}

HalMachine::HalMachine() : folder_(make_folder()) {
  hal_.emplace(std::vector<std::string>{folder_ + "/run", folder_, kUser});
  if (hal_->read_line() != "ready") {
    throw std::runtime_error("HAL does not come up: " + hal_->errors() + text_of(folder_ + "/log"));
  }
  const std::string parent = std::to_string(hal_->pid());
  std::istringstream(text_of("/proc/" + parent + "/task/" + parent + "/children")) >> pid_;
}

HalMachine::~HalMachine() {
  kill(std::stoi(pid_), SIGTERM);
  hal_->wait();
  fs::remove_all(folder_);
}

std::vector<std::string> HalMachine::inside(const std::vector<std::string>& arguments) const {
  std::vector<std::string> all{"/usr/bin/nsenter", "--target=" + pid_, "--ipc",          "--mount",         "setpriv",
                               "--reuid=" + kUser, "--regid=" + kUser, "--clear-groups", "--pdeathsig=KILL"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}

void HalMachine::command(const std::vector<std::string>& words) const {
  std::vector<std::string> arguments{"env", "HOME=" + folder_, "halcmd"};
  arguments.insert(arguments.end(), words.begin(), words.end());
  ChildProcess process(inside(arguments));
  if (process.wait() != 0) throw std::runtime_error("halcmd failed: " + process.errors());
}

ChildProcess HalMachine::feeder(double length_mm) const {
  return ChildProcess(inside({folder_ + "/feeder", "simulation", std::to_string(length_mm)}));
}

std::vector<HalSample> HalMachine::record() const {
  return record_until([](const HalSample& last) { return last.state == KCS_PLAYER_READY; });
}

std::vector<HalSample> HalMachine::record_until(unsigned long tick) const {
  return record_until([tick](const HalSample& last) { return last.tick >= tick; });
}

std::vector<HalSample> HalMachine::record_until(const std::function<bool(const HalSample&)>& is_end) const {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  std::vector<HalSample> samples = read_samples(folder_ + "/samples");
  while (samples.empty() || !is_end(samples.back())) {
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("the record does not come to an end");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    samples = read_samples(folder_ + "/samples");
  }
  return samples;
}

}  // namespace kcs::test
