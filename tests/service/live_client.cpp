#include "tests/service/live_client.h"

namespace kcs::service::test {

std::vector<v1::PlanLiveRequest> live(const std::vector<v1::CreatePlanRequest>& messages,
                                      const v1::LiveOutput& output) {
  std::vector<v1::PlanLiveRequest> list;
  for (const v1::CreatePlanRequest& message : messages) {
    v1::PlanLiveRequest& request = list.emplace_back();
    EXPECT_TRUE(request.ParseFromString(message.SerializeAsString()));
  }
  *list.front().mutable_output() = output;
  return list;
}

v1::LiveOutput every(double period) {
  v1::LiveOutput output;
  output.set_period_s(period);
  return output;
}

LiveAnswer LiveClient::read_all() {
  LiveAnswer answer;
  for (v1::PlanLiveResponse response; read(response);) {
    if (response.has_setpoints()) answer.setpoints.push_back(response.setpoints());
    if (response.has_plan()) answer.plans.push_back(response.plan());
    answer.corners.insert(answer.corners.end(), response.corners().corners().begin(),
                          response.corners().corners().end());
  }
  answer.status = stream_->Finish();
  return answer;
}

LiveAnswer LiveClient::exchange(const std::vector<v1::PlanLiveRequest>& messages) {
  std::jthread writer([&] {
    for (const v1::PlanLiveRequest& message : messages) {
      if (!write(message)) return;
    }
    end_path();
  });
  return read_all();
}

}  // namespace kcs::service::test
