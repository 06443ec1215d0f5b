// One request over HTTP, as calls of the service within its process.
#pragma once

#include <kcs/v1/planning.grpc.pb.h>

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "server/http/json_answer.h"

namespace kcs::http {

// The service knows the caller by the metadata alone, and counts, limits, queues, logs and ends these calls like any
// others. Once is_wanted says no, the running call is cancelled.
class PlanCall {
 public:
  using Metadata = std::map<std::string, std::string>;
  using IsWanted = std::function<bool()>;

  PlanCall(std::shared_ptr<v1::PlanningService::Stub> stub, Metadata metadata, IsWanted is_wanted)
      : stub_(std::move(stub)), metadata_(std::move(metadata)), is_wanted_(std::move(is_wanted)) {}

  // Takes a piece of the program; false when the service takes no more of it.
  using TakePiece = std::function<bool(const char* bytes, std::size_t size)>;
  // Hands the program on piece by piece; false if it broke off, which must not be planned.
  using ReadProgram = std::function<bool(const TakePiece& take)>;
  // Nothing if the program broke off.
  std::optional<Answer> create(const v1::PlanOptions& options, const ReadProgram& read_program);

  // A plan that the service keeps.
  Answer get(const std::string& name);

  // By what the log finds the calls; empty before one was answered.
  const std::string& request_id() const { return request_id_; }

 private:
  class Context;

  // The plan with its slow spots.
  Answer describe(const v1::Plan& plan);

  std::shared_ptr<v1::PlanningService::Stub> stub_;
  Metadata metadata_;
  IsWanted is_wanted_;
  std::string request_id_;
};

}  // namespace kcs::http
