#include "server/service/archive.h"

#include <kcs/v1/planning.pb.h>
#include <spdlog/spdlog.h>

#include <exception>

#include "server/jobs/cap_exceeded.h"
#include "server/service/encode.h"
#include "server/service/status.h"

namespace kcs::service {
namespace {

// Whether planning again would end the same way. Only then is it an outcome: others may have better luck.
bool is_final(const grpc::Status& status) {
  return status.error_code() == grpc::StatusCode::INVALID_ARGUMENT || status.error_code() == grpc::StatusCode::INTERNAL;
}

}  // namespace

Archive::Archive(const store::StoreSettings& settings, jobs::PlanCache& memory,
                 observe::Family<observe::Histogram>& durations)
    : settings_(settings), memory_(memory), durations_(durations) {}

void Archive::open() {
  if (open_ != nullptr) return;
  const observe::Histogram::Stopwatch stopwatch(durations_.with({"open"}));
  store_ = std::make_unique<store::Store>(settings_);
  open_ = store_.get();
}

store::Store& Archive::database() {
  store::Store* const database = open_;
  if (database == nullptr) throw store::StoreUnavailable("the store is not open yet");
  return *database;
}

template <typename Work>
auto Archive::timed(const char* operation, const Work& work) {
  const observe::Histogram::Stopwatch stopwatch(durations_.with({operation}));
  return work(database());
}

void Archive::keep(const jobs::PlanPointer& plan) {
  try {
    memory_.keep(plan);
  } catch (const jobs::CapExceeded&) {
    write_refusal(plan->name);  // it would be as large the next time
    throw;
  }
  finish(*plan);
}

void Archive::finish(const jobs::KeptPlan& plan) {
  const std::string outcome = encode_outcome(plan);
  timed("finish", [&](store::Store& database) {
    database.finish(plan.name, {.plan = outcome, .cycle_time = plan.plan.summary.cycle_time});
  });
}

void Archive::refuse(const jobs::RequestRecord& request, const std::exception_ptr& reason) noexcept {
  try {
    try {
      std::rethrow_exception(reason);
    } catch (const jobs::CapExceeded& reached) {
      if (!reached.retry_after()) write_refusal(request.name);  // likewise
    } catch (...) {
      if (is_final(end_by_current_exception().status)) write_refusal(request.name);
    }
  } catch (const std::exception& failure) {
    spdlog::warn("cannot note that {} was refused; it is going to be planned again: {}", request.name, failure.what());
  }
}

// Inside a catch clause.
void Archive::write_refusal(const std::string& name) {
  const std::string status = encode_refusal(end_by_current_exception().status);
  timed("refuse", [&](store::Store& database) { database.refuse(name, status); });
}

store::Record Archive::accept(const std::string& owner, const store::Request& request) {
  return timed("accept", [&](store::Store& database) { return database.accept(owner, request); });
}

store::Record Archive::accept_finished(const std::string& owner, const store::Request& request,
                                       const store::Finished& finished) {
  return timed("accept", [&](store::Store& database) { return database.accept_finished(owner, request, finished); });
}

std::optional<store::Record> Archive::record(const store::Whose& whose, const std::string& name) {
  return timed("find", [&](store::Store& database) { return database.find(whose, name); });
}

std::optional<std::string> Archive::request(const std::string& name) {
  return timed("request", [&](store::Store& database) { return database.request(name); });
}

store::Page Archive::list(const store::Whose& whose, const store::Filter& filter, std::size_t page_size,
                          const std::string& page_token) {
  return timed("list", [&](store::Store& database) { return database.list(whose, filter, page_size, page_token); });
}

store::Removal Archive::remove(const store::Whose& whose, const std::string& name) {
  return timed("remove", [&](store::Store& database) { return database.remove(whose, name); });
}

store::RunRecord Archive::add_run(const store::RunRecord& run) {
  return timed("add_run", [&](store::Store& database) { return database.add_run(run); });
}

void Archive::update_run(const store::RunRecord& run) {
  timed("update_run", [&](store::Store& database) { database.update_run(run); });
}

std::optional<store::RunRecord> Archive::find_run(const std::string& name) {
  return timed("find_run", [&](store::Store& database) { return database.find_run(name); });
}

std::optional<store::RunRecord> Archive::open_run(const std::string& machine) {
  return timed("open_run", [&](store::Store& database) { return database.open_run(machine); });
}

std::vector<std::string> Archive::claim(std::size_t most) {
  return timed("claim", [&](store::Store& database) { return database.claim(most); });
}

void Archive::release() {
  timed("release", [](store::Store& database) { database.release(); });
}

void Archive::sweep() {
  const auto gone = timed("sweep", [](store::Store& database) { return database.sweep(); });
  for (const std::string& name : gone) memory_.forget(name);
}

std::string encode_outcome(const jobs::KeptPlan& plan) {
  v1::Plan message;
  encode_plan(plan, message);
  return message.SerializeAsString();
}

}  // namespace kcs::service
