#include "server/http/plan_pages.h"

#include <httplib.h>

#include <algorithm>
#include <exception>
#include <string_view>

#include "server/http/json_answer.h"
#include "server/http/plan_call.h"

namespace kcs::http {
namespace {

// Thrown where a request is refused before the service sees it.
struct Refused : std::exception {
  explicit Refused(Answer answer_) : answer(std::move(answer_)) {}
  Answer answer;
};

[[noreturn]] void refuse(int status, const char* code, const std::string& message) {
  throw Refused(refusal(status, code, message));
}

bool is_on_this_machine(std::string_view ip) {
  return ip.starts_with("127.") || ip == "::1" || ip.starts_with("::ffff:127.");
}

// What goes on from HTTP's headers to the service, where it must be printable.
PlanCall::Metadata metadata_of(const httplib::Request& request) {
  const bool is_v6 = request.remote_addr.find(':') != std::string::npos;
  PlanCall::Metadata metadata = {
      {kPeerKey, (is_v6 ? "ipv6:[" + request.remote_addr + "]" : "ipv4:" + request.remote_addr) + ":" +
                     std::to_string(request.remote_port)}};
  for (const auto& [header, key] : {std::pair{"Authorization", "authorization"}, {"X-Request-Id", "x-request-id"}}) {
    if (!request.has_header(header)) continue;
    std::string value = request.get_header_value(header);
    if (!std::all_of(value.begin(), value.end(), [](char c) { return c >= ' ' && c <= '~'; })) {
      refuse(400, "INVALID_ARGUMENT", std::string(header) + " has characters that are not printable ASCII");
    }
    metadata.emplace(key, std::move(value));
  }
  return metadata;
}

void send(const Answer& answer, const std::string& request_id, httplib::Response& response) {
  response.status = answer.status;
  if (answer.status == 401) response.set_header("WWW-Authenticate", "Bearer");
  if (answer.retry_after_s) response.set_header("Retry-After", std::to_string(*answer.retry_after_s));
  if (!request_id.empty()) response.set_header("X-Request-Id", request_id);
  response.set_content(answer.body.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n",
                       "application/json");
}

}  // namespace

void PlanPages::add_to(httplib::Server& server) {
  server.Post(kPath, [this](const httplib::Request& request, httplib::Response& response,
                            const httplib::ContentReader& body) {
    answer(request, response, [&](PlanCall& call) {
      if (request.is_multipart_form_data()) {
        refuse(415, "INVALID_ARGUMENT", "the body must be the program itself: send it with curl --data-binary @FILE");
      }
      const std::multimap<std::string, std::string> query(request.params.begin(), request.params.end());
      const auto answer = call.create(options_of(query, options_.machines),
                                      [&body](const PlanCall::TakePiece& take) { return body(take); });
      if (!answer) refuse(408, "DEADLINE_EXCEEDED", "the program broke off, or came slower than 64 KiB a second");
      return *answer;
    });
  });
  server.Get(std::string(kPath) + "/([^/]+)", [this](const httplib::Request& request, httplib::Response& response) {
    answer(request, response, [&](PlanCall& call) { return call.get("plans/" + request.matches[1].str()); });
  });
}

template <typename Work>
void PlanPages::answer(const httplib::Request& request, httplib::Response& response, const Work& work) {
  const std::size_t running = running_++;
  std::string request_id;
  Answer answer;
  try {
    require_open_to(request);
    const std::shared_ptr<grpc::Channel> channel = channel_;
    if (!channel) refuse(503, "UNAVAILABLE", "the server is starting: try again");
    if (running >= options_.at_a_time) {
      Answer busy = refusal(503, "RESOURCE_EXHAUSTED",
                            "the cap http_plans of " + std::to_string(options_.at_a_time) +
                                " requests at the same time is reached: try again");
      busy.retry_after_s = 1;
      throw Refused(std::move(busy));
    }
    PlanCall call(v1::PlanningService::NewStub(channel), metadata_of(request),
                  [&request] { return request.progress(0, 0); });
    answer = work(call);
    request_id = call.request_id();
  } catch (const Refused& refused) {
    answer = refused.answer;
  } catch (const InvalidQuery& invalid) {
    answer = refusal(400, "INVALID_ARGUMENT", invalid.what(), invalid.parameter());
  } catch (const std::exception& failure) {
    answer = refusal(500, "INTERNAL", failure.what());
  }
  --running_;
  send(answer, request_id, response);
}

void PlanPages::require_open_to(const httplib::Request& request) const {
  if (!options_.closed_because.empty()) refuse(403, "PERMISSION_DENIED", options_.closed_because);
  if (options_.answers_network || is_on_this_machine(request.remote_addr)) return;
  refuse(
      403, "PERMISSION_DENIED",
      "plans over HTTP, which is not encrypted, are for this machine alone: call the service over gRPC with TLS, put "
      "a proxy that speaks TLS beside the server, or in a network that you trust set security.insecure");
}

}  // namespace kcs::http
