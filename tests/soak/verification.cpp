#include "tests/soak/verification.h"

#include <grpcpp/create_channel.h>

#include <memory>
#include <set>

#include "tests/soak/client.h"

namespace kcs::soak {
namespace {

constexpr int kMostStreamed = 300;

std::set<std::string> list(v1::PlanningService::Stub& stub, Tally& tally) {
  std::set<std::string> names;
  v1::ListPlansRequest request;
  request.set_page_size(1000);
  do {
    Call call;
    v1::ListPlansResponse response;
    if (!tally.count("ListPlans", call.began, stub.ListPlans(&call, request, &response), {})) return names;
    for (const v1::Plan& plan : response.plans()) {
      if (!names.insert(plan.name()).second) tally.fault(plan.name() + " is in the list twice");
    }
    request.set_page_token(response.next_page_token());
  } while (!request.page_token().empty());
  return names;
}

void await(v1::PlanningService::Stub& stub, const std::string& name, Tally& tally) {
  v1::WatchPlanRequest request;
  request.set_name(name);
  Call call(std::chrono::minutes(5));
  const auto reader = stub.WatchPlan(&call, request);
  v1::PlanProgress progress;
  while (reader->Read(&progress)) continue;
  tally.count("WatchPlan", call.began, reader->Finish(), {});
}

}  // namespace

Verdict verify(const std::string& address, const Ledger& ledger, Tally& tally) {
  const auto stub = v1::PlanningService::NewStub(grpc::CreateChannel(address, grpc::InsecureChannelCredentials()));
  const std::set<std::string> listed = list(*stub, tally);
  Verdict verdict;
  for (const Entry& entry : ledger.entries()) {
    ++verdict.acknowledged;
    v1::GetPlanRequest request;
    request.set_name(entry.name);
    const auto get = [&](v1::Plan& plan) {
      Call call;
      return tally.count("GetPlan", call.began, stub->GetPlan(&call, request, &plan), {});
    };
    v1::Plan plan;
    bool found = get(plan);
    if (found && plan.state() != v1::PLAN_STATE_READY) {
      await(*stub, entry.name, tally);
      found = get(plan);
    }
    if (!found || plan.state() != v1::PLAN_STATE_READY || !listed.contains(entry.name)) {
      ++verdict.lost;
      tally.fault(entry.name + " is lost");
      continue;
    }
    bool same = entry.content.empty() || entry.content == content_of(plan);
    if (entry.setpoints && verdict.streamed < kMostStreamed) {
      Call call;
      const StreamEnd end = read_setpoints(*stub, call, entry.name);
      same = tally.count("StreamSetpoints", call.began, end.status, {}) && *entry.setpoints == end.digest && same;
      ++verdict.streamed;
    }
    if (!same) {
      ++verdict.changed;
      tally.fault(entry.name + " is not what it was");
    }
  }
  return verdict;
}

}  // namespace kcs::soak
