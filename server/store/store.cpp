#include "server/store/store.h"

#include <fmt/format.h>

#include "server/store/connections.h"
#include "server/store/leases.h"
#include "server/store/listing.h"
#include "server/store/plan_rows.h"
#include "server/store/request_rows.h"
#include "server/store/retention.h"
#include "server/store/run_rows.h"
#include "server/store/schema.h"

namespace kcs::store {
namespace {

// Use is noted when it was not noted for this part of the time for which plans are kept: reading rarely writes.
constexpr int kNotesOfUse = 24;

// A text with a zero in it is in no database; some would look for what stands before it.
bool can_be_kept(const std::string& text) { return text.find('\0') == std::string::npos; }

}  // namespace

struct Store::Parts {
  explicit Parts(const StoreSettings& given) : settings(given), connections(given), leases(given.lease) {}

  Record keep(const std::string& owner, const Request& request, const Finished* finished);
  void settle(const std::string& name, State state, std::string_view outcome, std::optional<double> cycle_time);
  void note_use(const std::string& name);

  const StoreSettings settings;
  Connections connections;
  Leases leases;
};

Record Store::Parts::keep(const std::string& owner, const Request& request, const Finished* finished) {
  const Dialect& dialect = connections.dialect();
  const PackedRequest packed(request.bytes);
  return connections.write(request.name, [&](soci::session& session) {
    insert_plan(session, dialect, request, packed);
    insert_owner(session, dialect, owner, request.name);
    if (finished) {
      settle_plan(session, dialect, request.name, State::kFinished, finished->plan, finished->cycle_time,
                  Refusal::kIsReplaced);
    } else {
      leases.take(session, dialect, request.name);
    }
    touch_plan(session, dialect, request.name);
    return *select_plan(session, dialect, leases.planner(), owner, request.name);
  });
}

void Store::Parts::settle(const std::string& name, State state, std::string_view outcome,
                          std::optional<double> cycle_time) {
  connections.write(name, [&](soci::session& session) {
    settle_plan(session, connections.dialect(), name, state, outcome, cycle_time);
    return true;
  });
}

void Store::Parts::note_use(const std::string& name) {
  const auto interval = std::chrono::microseconds(settings.keep).count() / kNotesOfUse;
  const Dialect& dialect = connections.dialect();
  try {
    connections.read([&](soci::session& session) {
      int is_noted = 0;
      session << fmt::format("select count(*) from plans where name = :name and use_time >= {} - {}", dialect.now(),
                             interval),
          soci::use(name, "name"), soci::into(is_noted);
      if (!is_noted) touch_plan(session, dialect, name);
      return true;
    });
  } catch (const StoreError&) {
    // The disk may be full, say: that is no reason to keep the plan from its reader.
  }
}

Store::Store(const StoreSettings& settings) : parts_(std::make_unique<Parts>(settings)) {
  prepare_schema(parts_->connections);
}

Store::~Store() = default;

Record Store::accept(const std::string& owner, const Request& request) {
  if (std::optional<Record> known = find(owner, request.name); known && known->state != State::kAccepted) {
    return *std::move(known);
  }
  return parts_->keep(owner, request, nullptr);
}

Record Store::accept_finished(const std::string& owner, const Request& request, const Finished& finished) {
  return parts_->keep(owner, request, &finished);
}

void Store::finish(const std::string& name, const Finished& finished) {
  parts_->settle(name, State::kFinished, finished.plan, finished.cycle_time);
}

void Store::refuse(const std::string& name, std::string_view status) {
  parts_->settle(name, State::kRefused, status, std::nullopt);
}

std::optional<Record> Store::find(const Whose& whose, const std::string& name) {
  if (!can_be_kept(name)) return std::nullopt;
  std::optional<Record> found = parts_->connections.read([&](soci::session& session) {
    return select_plan(session, parts_->connections.dialect(), parts_->leases.planner(), whose, name);
  });
  if (found) parts_->note_use(name);
  return found;
}

std::optional<std::string> Store::request(const std::string& name) {
  if (!can_be_kept(name)) return std::nullopt;
  return read_request(parts_->connections, name);
}

Page Store::list(const Whose& whose, const Filter& filter, std::size_t page_size, const std::string& page_token) {
  if (filter.machine_name && !can_be_kept(*filter.machine_name)) return {};
  return list_plans(parts_->connections, parts_->leases.planner(), whose, filter, page_size, page_token);
}

Removal Store::remove(const Whose& whose, const std::string& name) {
  if (!can_be_kept(name)) return Removal::kNotFound;
  return parts_->connections.write(name, [&](soci::session& session) { return delete_owner(session, whose, name); });
}

std::vector<std::string> Store::claim(std::size_t most) { return parts_->leases.claim(parts_->connections, most); }

void Store::release() { parts_->leases.release(parts_->connections); }

RunRecord Store::add_run(const RunRecord& run) {
  std::optional<RunRecord> tried;  // if the connection died, perhaps after the database had done it
  return parts_->connections.write(run.plan, [&](soci::session& session) {
    RunRecord added = run;
    added.name = fmt::format("{}/runs/{}", run.machine, take_run_number(session, run.machine));
    if (std::optional<RunRecord> open = select_open_run(session, run.machine)) {
      if (tried && tried->name == open->name && tried->create_time == open->create_time) return *std::move(open);
      throw MachineHasRun(
          fmt::format("{} has {}, which is not over: wait for its end, or abort it", run.machine, open->name));
    }
    if (!has_plan(session, run.plan)) {
      throw PlanNotKept(fmt::format("{} is not kept any more: have it planned again", run.plan));
    }
    const Dialect& dialect = parts_->connections.dialect();
    insert_run(session, dialect, added);
    insert_owner(session, dialect, added.name, run.plan);
    touch_plan(session, dialect, run.plan);
    tried = select_run(session, added.name);
    return *tried;
  });
}

void Store::update_run(const RunRecord& run) {
  parts_->connections.write(run.plan, [&](soci::session& session) {
    const Dialect& dialect = parts_->connections.dialect();
    store::update_run(session, dialect, run);
    if (run.state == RunRecordState::kOpen) return true;
    touch_plan(session, dialect, run.plan);
    delete_owner(session, run.name, run.plan);
    return true;
  });
}

std::optional<RunRecord> Store::find_run(const std::string& name) {
  if (!can_be_kept(name)) return std::nullopt;
  return parts_->connections.read([&](soci::session& session) { return select_run(session, name); });
}

std::optional<RunRecord> Store::open_run(const std::string& machine) {
  if (!can_be_kept(machine)) return std::nullopt;
  return parts_->connections.read([&](soci::session& session) { return select_open_run(session, machine); });
}

std::vector<std::string> Store::sweep() { return store::sweep(parts_->connections, parts_->settings); }

}  // namespace kcs::store
