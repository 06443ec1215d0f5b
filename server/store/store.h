// Requests and what came of them, and the runs of machines, kept in a database.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/errors.h"
#include "server/store/records.h"
#include "server/store/run_record.h"
#include "server/store/settings.h"

namespace kcs::store {

// Keeps requests under their names, once each, and who owns them. An owner sees and removes only what is his; the data
// goes with its last owner, or for all of them together where everybody's plans are meant. What a call has changed when
// it returns is on the disk of the database: a crash or a power failure does not lose it, and what is half done is
// never seen (PostgreSQL: as far as its own settings promise that). Trajectories are not kept here: the request makes
// them again.
//
// Every method may be called by many threads, and by many servers that share a database, at the same moment. Each
// throws StoreUnavailable if the database is gone, StoreFull if its disk is full (writing only), StoreError otherwise;
// all may be called again after that.
class Store {
 public:
  // Opens or makes the database and brings an older schema up to date. Throws StoreUnavailable if the database is not
  // there yet, StoreError if it cannot be used: wrong settings, no database, damaged, of a newer kcsd.
  explicit Store(const StoreSettings& settings);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  // Keeps a request that is to be planned, and takes it to be planned here unless another server has it. Doing it again
  // changes nothing.
  Record accept(const std::string& owner, const Request& request);
  // Keeps a request together with its plan, also one that was refused before: with other caps, say.
  Record accept_finished(const std::string& owner, const Request& request, const Finished& finished);

  // Keeps the outcome of an accepted request: `status` says why it was refused. The first outcome stays; what is not
  // kept any more is left alone.
  void finish(const std::string& name, const Finished& finished);
  void refuse(const std::string& name, std::string_view status);

  // The plan; none if it is not kept or is somebody else's. It counts as used now.
  std::optional<Record> find(const Whose& whose, const std::string& name);
  // The bytes of a request, whoever owns it; none if it is not kept.
  std::optional<std::string> request(const std::string& name);
  // One page of these plans, the latest first: 1 to `page_size` of them, those after the page that gave
  // `page_token` (empty: from the first). What is added or removed meanwhile neither repeats nor hides another plan.
  // Throws InvalidPageToken unless the token comes from a page of the same list and filter.
  Page list(const Whose& whose, const Filter& filter, std::size_t page_size, const std::string& page_token);

  Removal remove(const Whose& whose, const std::string& name);

  // The names of what this server has to plan: accepted, without outcome, the earliest first. It says at the same time
  // that this server is alive, and takes over what has lost its server, until it has `most` of them. Call it after the
  // start and at least three times during a lease.
  std::vector<std::string> claim(std::size_t most);
  // Gives back what this server has not planned yet, so that others need not wait for its lease to end. For an orderly
  // stop.
  void release();

  // Begins a run: `run` says everything but its name, state and create time, which it is given. The number in the name
  // is the machine's next: no other run ever had it or will have it. Throws MachineHasRun if the machine has an open
  // run, also one that another server adds at the same moment, PlanNotKept if the plan is gone. After StoreUnavailable
  // it may have been added or not: open_run() tells.
  //
  // The plan belongs to the run as well for as long as that is open: find(name of the run, plan) has it, and it is
  // neither forgotten nor gone when everybody else has removed it; then it goes with the end of the run.
  RunRecord add_run(const RunRecord& run);
  // Writes down how an open run goes, or that it is over: all but its name, machine, plan and create time. A run that
  // is over, or not kept, is left alone.
  void update_run(const RunRecord& run);
  // None if it is not kept.
  std::optional<RunRecord> find_run(const std::string& name);
  // The machine's run that is not over; none if there is none.
  std::optional<RunRecord> open_run(const std::string& machine);

  // Forgets what was not used for too long or is too much in all, except what waits to be planned or an open run needs;
  // some hundred plans at most, the next call goes on. Forgets runs that have been over for too long. The names of the
  // plans that are gone. Call it every minute or so.
  std::vector<std::string> sweep();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace kcs::store
