#include "server/service/machine_service.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <optional>
#include <string>
#include <thread>

#include "server/service/machine_messages.h"
#include "server/service/violations.h"

namespace kcs::service {
namespace {

using AttachStream = grpc::ServerReaderWriter<v1::AttachMachineResponse, v1::AttachMachineRequest>;

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kOrderLook{20}, kLook{2}, kNoPatience{0};
// Gateways without a run report five times a second.
constexpr std::chrono::milliseconds kNextReport{500};
// A call that says nothing for longer is broken, whatever its connection looks like: a machine without one has stopped
// long before. So much sooner the other side is given a sign of life.
constexpr std::chrono::milliseconds kLongestSilence{3000}, kSignOfLife{1000};
constexpr double kPercent = 100;

// Takes a gateway's reports in a thread of its own.
class Reports {
 public:
  Reports(AttachStream& stream, grpc::ServerContext& context, MachineRuns& runs, runs::Machine& machine)
      : context_(context), thread_([this, &stream, &runs, &machine] { read(stream, runs, machine); }) {}
  // The next report ends the thread. If none comes, only breaking the call does, and its status is lost.
  ~Reports() {
    ending_ = true;
    for (const auto end = Clock::now() + kNextReport; !over_ && Clock::now() < end;) std::this_thread::sleep_for(kLook);
    if (!over_) context_.TryCancel();
  }
  Reports(const Reports&) = delete;
  Reports& operator=(const Reports&) = delete;

  bool over() const { return over_; }
  Clock::duration silent_for() const { return Clock::now() - last_.load(); }
  // What was wrong with the last one, if it ended for that.
  void rethrow() const {
    if (over_ && fault_) std::rethrow_exception(fault_);
  }

 private:
  void read(AttachStream& stream, MachineRuns& runs, runs::Machine& machine) {
    try {
      std::optional<runs::Run> noted;
      v1::AttachMachineRequest message;
      while (stream.Read(&message) && !ending_) {
        last_ = Clock::now();
        machine.report(decode_report(message.report(), machine.profile().limits.axes));
        runs.note(machine, noted);
      }
    } catch (...) {
      fault_ = std::current_exception();
    }
    over_ = true;
  }

  grpc::ServerContext& context_;
  std::exception_ptr fault_;  // not to be read before over_
  std::atomic<bool> over_ = false, ending_ = false;
  std::atomic<Clock::time_point> last_ = Clock::now();
  std::jthread thread_;  // last: it uses all the others
};

// Thrown where an attached machine's call is to end.
struct Ended {
  grpc::Status status = {};
};

v1::AttachMachineRequest read_message(AttachStream& stream, const char* what) {
  v1::AttachMachineRequest message;
  if (!stream.Read(&message)) refuse(what, "is missing: send the hello first, then reports");
  return message;
}

double decode_rate(double percent) {
  Violations violations;
  violations.check_range("feed_override_percent", percent, 0, 200, "%");
  violations.refuse();
  return percent / kPercent;
}

}  // namespace

MachineService::MachineService(Machines& machines, MachineRuns& runs, const Caps& caps, Calls& calls)
    : machines_(machines),
      runs_(runs),
      calls_(calls),
      // Each machine, and those that attach anew before their old call has ended.
      attaching_({"machines", 2 * caps.machines}, {"machines", 2 * caps.machines}),
      watching_({"streams", caps.streams}, {"client_streams", caps.client_streams}) {}

grpc::Status MachineService::AttachMachine(grpc::ServerContext* context, AttachStream* stream) {
  return calls_.answer("AttachMachine", *context, [&](CallRecord& call, const Caller& caller) -> grpc::Status {
    const Gate::Pass pass(attaching_, caller.client);
    const v1::MachineHello hello = read_message(*stream, "hello").hello();
    const runs::MachineProfile profile = decode_hello(hello);
    call.note("machine", profile.name);
    const std::size_t axes = profile.limits.axes;
    const runs::MachineReport first = decode_report(read_message(*stream, "report").report(), axes);
    const Machines::Attachment attachment(machines_, profile, hello.instance(), first);
    runs::Machine& machine = attachment.machine();
    const auto known = machine.run();
    const bool is_new = !first.run.empty() && (!known || known->name != first.run);
    Reports reports(*stream, *context, runs_, machine);
    auto said = Clock::now();
    // Hands on an order, or gives a sign of life when one is due. Throws what ends the call.
    const auto attend = [&](std::chrono::milliseconds patience) {
      caller.require_wanted();
      if (reports.over() || attachment.superseded()) throw Ended();
      if (reports.silent_for() > kLongestSilence) {
        throw Ended{{grpc::StatusCode::UNAVAILABLE, "no report has come for three seconds; attach anew"}};
      }
      const auto order = machine.next_order(patience);
      if (!order && Clock::now() - said < kSignOfLife) return;
      if (!stream->Write(order ? encode_order(*order, axes) : v1::AttachMachineResponse())) throw Ended();
      said = Clock::now();
    };
    Caller attending = caller;
    attending.require_wanted = [&attend] { attend(kNoPatience); };
    try {
      if (is_new) runs_.take_up(attending, machine, first.run);
      while (true) {
        if (calls_.closed() && !machine.has_open_run()) throw Stopping();  // it can attach elsewhere at once
        attend(kOrderLook);
      }
    } catch (const Ended& end) {
      if (attachment.superseded()) context->TryCancel();  // nobody listens any more
      reports.rethrow();
      return end.status;
    }
  });
}

grpc::Status MachineService::ListMachines(grpc::ServerContext* context, const v1::ListMachinesRequest* /*request*/,
                                          v1::ListMachinesResponse* response) {
  return calls_.answer("ListMachines", *context, [&](CallRecord& /*call*/, const Caller& /*caller*/) {
    for (const Machines::MachinePointer& machine : machines_.all()) encode_machine(*machine, *response->add_machines());
    return grpc::Status::OK;
  });
}

template <typename Work>
grpc::Status MachineService::answer(std::string_view method, grpc::ServerContext& context, const std::string& run,
                                    v1::Run& answer, const Work& work) {
  return calls_.answer(method, context, [&](CallRecord& call, const Caller& caller) {
    call.note("run", run);
    answer = encode_run(work(caller), machines_);
    return grpc::Status::OK;
  });
}

grpc::Status MachineService::RunPlan(grpc::ServerContext* context, const v1::RunPlanRequest* request, v1::Run* run) {
  return answer("RunPlan", *context, request->machine(), *run, [&](const Caller& caller) {
    check_machine_name("machine", request->machine());
    const double rate = request->has_feed_override_percent() ? decode_rate(request->feed_override_percent()) : 1;
    return runs_.begin(caller, request->machine(), request->plan(), rate);
  });
}

grpc::Status MachineService::GetRun(grpc::ServerContext* context, const v1::GetRunRequest* request, v1::Run* run) {
  return answer("GetRun", *context, request->name(), *run,
                [&](const Caller& /*caller*/) { return runs_.get(request->name()); });
}

grpc::Status MachineService::HoldRun(grpc::ServerContext* context, const v1::HoldRunRequest* request, v1::Run* run) {
  return answer("HoldRun", *context, request->name(), *run,
                [&](const Caller& /*caller*/) { return runs_.hold(request->name()); });
}

grpc::Status MachineService::ResumeRun(grpc::ServerContext* context, const v1::ResumeRunRequest* request,
                                       v1::Run* run) {
  return answer("ResumeRun", *context, request->name(), *run,
                [&](const Caller& caller) { return runs_.resume(caller, request->name(), request->take_over()); });
}

grpc::Status MachineService::AbortRun(grpc::ServerContext* context, const v1::AbortRunRequest* request, v1::Run* run) {
  return answer("AbortRun", *context, request->name(), *run,
                [&](const Caller& /*caller*/) { return runs_.abort(request->name()); });
}

grpc::Status MachineService::SetFeedOverride(grpc::ServerContext* context, const v1::SetFeedOverrideRequest* request,
                                             v1::Run* run) {
  return answer("SetFeedOverride", *context, request->name(), *run, [&](const Caller& caller) {
    return runs_.set_rate(caller, request->name(), decode_rate(request->feed_override_percent()), request->take_over());
  });
}

grpc::Status MachineService::WatchRun(grpc::ServerContext* context, const v1::WatchRunRequest* request,
                                      grpc::ServerWriter<v1::Run>* writer) {
  return calls_.answer("WatchRun", *context, [&](CallRecord& call, const Caller& caller) {
    call.note("run", request->name());
    const Gate::Pass pass(watching_, caller.client);
    runs_.watch(caller, request->name(), [&](const runs::Run& run) {
      if (!writer->Write(encode_run(run, machines_))) throw Cancelled();
    });
    return grpc::Status::OK;
  });
}

}  // namespace kcs::service
