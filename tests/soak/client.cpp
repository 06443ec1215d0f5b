#include "tests/soak/client.h"

#include <fmt/format.h>
#include <grpcpp/create_channel.h>

#include <array>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

namespace kcs::soak {
namespace {

using Code = grpc::StatusCode;

std::unique_ptr<v1::PlanningService::Stub> connect(const std::string& address) {
  grpc::ChannelArguments own;
  own.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  own.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 500);
  return v1::PlanningService::NewStub(grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), own));
}

}  // namespace

Client::Client(const std::string& address, std::uint64_t seed, Ledger& ledger, Tally& tally)
    : random_(seed), stub_(connect(address)), ledger_(ledger), tally_(tally) {}

void Client::work(const std::stop_token& stop) {
  struct Action {
    int weight;
    std::function<void()> run;
  };
  const std::array actions = {Action{30, [&] { create(Size::kSmall); }},
                              Action{6, [&] { create(Size::kMedium); }},
                              Action{1, [&] { create(Size::kLarge); }},
                              Action{5, [&] { create_without_waiting(Size::kSmall); }},
                              Action{3, [&] { create_without_waiting(Size::kMedium); }},
                              Action{3, [&] { create_and_give_up(); }},
                              Action{3, [&] { create_with_little_time(); }},
                              Action{2, [&] { create_nonsense(); }},
                              Action{5, [&] { create_again(); }},
                              Action{8, [&] { get(); }},
                              Action{4, [&] { watch(); }},
                              Action{4, [&] { list(); }},
                              Action{8, [&] { remove(); }},
                              Action{12, [&] { stream(); }},
                              Action{4, [&] { stream_and_give_up(); }},
                              Action{1, [&] { stream_at_pace(stop); }},
                              Action{1, [&] { stream_slowly(stop); }},
                              Action{3, [&] { describe_corners(); }},
                              Action{3, [&] { plan_live(); }}};
  std::vector<int> weights;
  for (const Action& action : actions) weights.push_back(action.weight);
  std::discrete_distribution<std::size_t> choice(weights.begin(), weights.end());
  while (!stop.stop_requested()) {
    actions[choice(random_)].run();
    std::this_thread::sleep_for(std::chrono::milliseconds(whole(0, 20)));
  }
}

Recipe Client::recipe(Size size) { return {.seed = random_(), .size = size}; }

grpc::Status Client::send(Call& call, const std::vector<v1::CreatePlanRequest>& messages, v1::Plan& plan) {
  const auto writer = stub_->CreatePlan(&call, &plan);
  for (const v1::CreatePlanRequest& message : messages) {
    if (!writer->Write(message)) break;
  }
  writer->WritesDone();
  return writer->Finish();
}

bool Client::count(const std::string& method, const Call& call, const grpc::Status& status, const std::string& plan,
                   std::initializer_list<Code> expected) {
  if (status.error_code() == Code::NOT_FOUND && !ledger_.holds(plan)) {
    return tally_.count(method, call.began, status, {Code::NOT_FOUND});
  }
  return tally_.count(method, call.began, status, expected);
}

void Client::compare(const v1::Plan& plan) {
  if (!ledger_.agrees(plan.name(), plan)) tally_.fault(plan.name() + " is not what it was");
}

void Client::create(Size size) {
  const Recipe made_from = recipe(size);
  std::vector<v1::CreatePlanRequest> request = messages(made_from);
  request.front().set_priority(size == Size::kSmall ? v1::PRIORITY_INTERACTIVE : v1::PRIORITY_BATCH);
  Call call;
  v1::Plan plan;
  const grpc::Status status = send(call, request, plan);
  if (!tally_.count("CreatePlan", call.began, status, {Code::RESOURCE_EXHAUSTED})) return;
  if (size == Size::kSmall) tally_.small_plan(call.began);
  if (plan.state() != v1::PLAN_STATE_READY) tally_.fault(plan.name() + " was made, but is not READY");
  ledger_.add({.name = plan.name(), .recipe = made_from, .content = content_of(plan)});
}

void Client::create_without_waiting(Size size) {
  const Recipe made_from = recipe(size);
  std::vector<v1::CreatePlanRequest> request = messages(made_from);
  request.front().set_accept_only(true);
  Call call;
  v1::Plan plan;
  if (!tally_.count("CreatePlan (accept)", call.began, send(call, request, plan), {Code::RESOURCE_EXHAUSTED})) return;
  ledger_.add({.name = plan.name(), .recipe = made_from});
}

void Client::create_and_give_up() {
  std::vector<v1::CreatePlanRequest> request = messages(recipe(Size::kMedium));
  request.resize(request.size() / 2 + 1);
  Call call;
  v1::Plan plan;
  const auto writer = stub_->CreatePlan(&call, &plan);
  for (const v1::CreatePlanRequest& message : request) {
    if (!writer->Write(message)) break;
  }
  call.TryCancel();
  tally_.count("CreatePlan", call.began, writer->Finish(), {Code::CANCELLED});
}

void Client::create_with_little_time() {
  const Recipe made_from = recipe(Size::kMedium);
  Call call(std::chrono::milliseconds(whole(1, 30)));
  v1::Plan plan;
  const grpc::Status status = send(call, messages(made_from), plan);
  if (tally_.count("CreatePlan", call.began, status, {Code::DEADLINE_EXCEEDED, Code::RESOURCE_EXHAUSTED})) {
    ledger_.add({.name = plan.name(), .recipe = made_from, .content = content_of(plan)});
  }
}

void Client::create_nonsense() {
  std::vector<v1::CreatePlanRequest> request = messages(recipe(Size::kSmall));
  request.front().mutable_options()->mutable_machine()->set_jerk_mm_s3(whole(0, 2), -1);
  Call call;
  v1::Plan plan;
  const grpc::Status status = send(call, request, plan);
  if (tally_.count("CreatePlan", call.began, status, {Code::INVALID_ARGUMENT})) tally_.fault("nonsense was planned");
}

void Client::create_again() {
  const std::optional<Entry> known = ledger_.take(random_);
  if (!known) return;
  Call call;
  v1::Plan plan;
  const grpc::Status status = send(call, messages(known->recipe), plan);
  ledger_.add(*known);
  if (!tally_.count("CreatePlan (again)", call.began, status, {Code::RESOURCE_EXHAUSTED})) return;
  if (plan.name() != known->name) tally_.fault(known->name + " is " + plan.name() + " when asked for again");
  compare(plan);
}

// A call that is cut may have deleted the plan or not: it is in the ledger no more in any case.
void Client::remove() {
  if (whole(0, 3) > 0) return;  // others shall have something to ask for
  const std::optional<Entry> known = ledger_.take(random_);
  if (!known) return;
  v1::DeletePlanRequest request;
  request.set_name(known->name);
  Call call;
  google::protobuf::Empty nothing;
  if (!tally_.count("DeletePlan", call.began, stub_->DeletePlan(&call, request, &nothing), {})) return;
  v1::GetPlanRequest again;
  again.set_name(known->name);
  Call look;
  v1::Plan plan;
  if (tally_.count("GetPlan", look.began, stub_->GetPlan(&look, again, &plan), {Code::NOT_FOUND})) {
    tally_.fault(known->name + " was deleted, and is there");
  }
}

}  // namespace kcs::soak
