#include "client/gateway/machine/machine_link.h"

#include <grpcpp/support/sync_stream.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "client/sdk/call_context.h"
#include "client/sdk/channel.h"
#include "client/sdk/machine_key.h"

namespace kcs::gateway {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kLookForNews{4};
constexpr milliseconds kIdleReport{200};
constexpr milliseconds kFirstPause{50};
constexpr milliseconds kLongestPause{1000};
constexpr milliseconds kPauseAfterRefusal{2000};
// A server that refuses does so sooner, and one that takes the machine may have nothing to say for longer.
constexpr milliseconds kTakenAfter{1000};
// Servers give a sign of life each second.
constexpr milliseconds kLongestSilence{3000};

// kcsd lets a client ping every 5 s.
constexpr client::ChannelPace kPace = {.ping_after_silence = milliseconds(6000),
                                       .ping_timeout = milliseconds(2000),
                                       .first_pause = milliseconds(100),
                                       .longest_pause = kLongestPause};

using Stream = grpc::ClientReaderWriter<v1::AttachMachineRequest, v1::AttachMachineResponse>;

// Reports until the stream is broken off, by either side.
class Reporter {
 public:
  Reporter(Stream& stream, Feeder& feeder, const v1::MachineHello& hello)
      : stream_(stream), feeder_(feeder), run_interval_(std::chrono::duration<double>(hello.report_s())) {
    request_.mutable_hello()->CopyFrom(hello);
    open_ = stream_.Write(request_);
  }

  // Sends a report if one is due. False if the stream takes no more.
  bool report() {
    const std::uint64_t revision = feeder_.revision();
    const auto now = Clock::now();
    const std::chrono::duration<double> interval = feeder_.has_run() ? run_interval_ : kIdleReport;
    if (sent_any_ && revision == revision_ && now - last_ < interval) return open_;
    *request_.mutable_report() = feeder_.report();
    open_ = open_ && stream_.Write(request_);
    sent_any_ = true;
    revision_ = revision;
    last_ = now;
    return open_;
  }

 private:
  Stream& stream_;
  Feeder& feeder_;
  std::chrono::duration<double> run_interval_;
  v1::AttachMachineRequest request_;
  bool open_ = false;
  bool sent_any_ = false;
  std::uint64_t revision_ = 0;
  Clock::time_point last_;
};

void wait(const std::stop_token& stop, milliseconds time) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any().wait_for(lock, stop, time, [] { return false; });
}

bool is_refusal(grpc::StatusCode code) {
  switch (code) {
    case grpc::StatusCode::ALREADY_EXISTS:
    case grpc::StatusCode::UNAUTHENTICATED:
    case grpc::StatusCode::PERMISSION_DENIED:
    case grpc::StatusCode::INVALID_ARGUMENT:
    case grpc::StatusCode::UNIMPLEMENTED:
      return true;
    default:
      return false;
  }
}

}  // namespace

MachineLink::MachineLink(const client::Connection& server, v1::MachineHello hello, Feeder& feeder,
                         std::shared_ptr<spdlog::logger> log)
    : server_(server),
      hello_(std::move(hello)),
      feeder_(feeder),
      log_(std::move(log)),
      channel_(client::open_channel(server, kPace)),
      stub_(v1::MachineService::NewStub(channel_)) {}

void MachineLink::run(const std::stop_token& stop) {
  for (milliseconds pause = kFirstPause; !stop.stop_requested();) {
    const Attempt attempt = attach(stop);
    if (stop.stop_requested()) return;
    tell_lost(attempt);
    if (attempt.attached) pause = kFirstPause;
    wait(stop, is_refusal(attempt.status.error_code()) ? kPauseAfterRefusal : pause);
    pause = std::min(pause * 2, kLongestPause);
  }
}

MachineLink::Attempt MachineLink::attach(const std::stop_token& stop) {
  // Without somebody who waits for it, gRPC looks after a new connection every five seconds only.
  if (!channel_->WaitForConnected(std::chrono::system_clock::now() + kLongestPause)) {
    return {.status = {grpc::StatusCode::UNAVAILABLE, "there is no connection"}, .attached = false};
  }
  client::CallContext context(stop);
  client::say_machine(context, hello_.machine());
  const std::unique_ptr<Stream> stream = stub_->AttachMachine(&context);
  Reporter reporter(*stream, feeder_, hello_);
  const auto begin = Clock::now();
  std::atomic<bool> heard = false;
  std::atomic<Clock::time_point> last_heard = begin;
  std::atomic<bool> ended = false;
  {
    std::jthread reader([&] {
      for (v1::AttachMachineResponse order; stream->Read(&order);) {
        heard = true;
        last_heard = Clock::now();
        feeder_.take(order);
      }
      ended = true;
    });
    bool told = false;
    while (!ended && reporter.report()) {
      if (!told && (heard || Clock::now() - begin > kTakenAfter)) {
        tell_attached();
        told = true;
      }
      if (Clock::now() - last_heard.load() > kLongestSilence) {
        // Its connection may look sound, and still swallow what is sent: the next attempt gets another one.
        context.TryCancel();
        channel_ = client::open_channel(server_, kPace);
        stub_ = v1::MachineService::NewStub(channel_);
        break;
      }
      std::this_thread::sleep_for(kLookForNews);
    }
  }
  return {.status = stream->Finish(), .attached = heard || Clock::now() - begin > kTakenAfter};
}

void MachineLink::tell_attached() {
  log_->info("attached server={} machine={}", server_.address, hello_.machine());
  told_.clear();
}

void MachineLink::tell_lost(const Attempt& attempt) {
  const std::string reason = attempt.status.ok() ? "the server ended the call" : attempt.status.error_message();
  if (reason == told_) return;
  log_->warn("{} server={} code={} reason={:?}", attempt.attached ? "link lost" : "not attached", server_.address,
             static_cast<int>(attempt.status.error_code()), reason);
  told_ = reason;
}

}  // namespace kcs::gateway
