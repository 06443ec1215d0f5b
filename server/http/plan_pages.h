// The pages under /v1/plans: the planning service over HTTP.
#pragma once

#include <grpcpp/channel.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <string>

#include "server/http/plan_query.h"

namespace httplib {
class Server;
struct Request;
struct Response;
}  // namespace httplib

namespace kcs::http {

// How the key of the metadata begins that says for whom a call within the process is made: "ipv4:192.0.2.7:51234".
inline constexpr const char* kPeerKey = "x-kcs-http-peer";

//   POST /v1/plans?…      plans the G-code program in the body (plan_query.h), answers with the plan
//   GET  /v1/plans/ID     the plan of that name, if the service keeps it
// Both are answered in JSON (json_answer.h), by the service itself, to whom the token in the header "Authorization:
// Bearer TOKEN" goes on.
class PlanPages {
 public:
  struct Options {
    Machines machines;
    std::size_t at_a_time = 8;  // requests that are answered at the same time
    // Why nobody is answered; empty: there is no reason. And whether those on other machines are answered.
    std::string closed_because;
    bool answers_network = false;
  };

  explicit PlanPages(Options options) : options_(std::move(options)) {}

  // Where the pages are.
  static constexpr const char* kPath = "/v1/plans";
  std::size_t at_a_time() const { return options_.at_a_time; }
  void add_to(httplib::Server& server);

  // From now on requests go to the service behind the channel; before, they are answered 503.
  void open(std::shared_ptr<grpc::Channel> channel) { channel_ = std::move(channel); }

 private:
  template <typename Work>
  void answer(const httplib::Request& request, httplib::Response& response, const Work& work);
  void require_open_to(const httplib::Request& request) const;

  const Options options_;
  std::atomic<std::shared_ptr<grpc::Channel>> channel_;
  std::atomic<std::size_t> running_ = 0;
};

}  // namespace kcs::http
