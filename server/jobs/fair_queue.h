// Who is next: fair shares of the planning time between clients.
#pragma once

#include <chrono>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace kcs::jobs {

// Who pays for the time that a job takes: any name of a client, the same for all its requests.
using Client = std::string;

// Which of a client's own jobs go first. Priorities of different clients are not compared.
enum class Priority { kBatch, kNormal, kInteractive };

using JobId = std::uint64_t;

// Jobs that wait for their turns. A job may take many turns; between them it waits in the place that it had.
//
// The next turn is that of the client that has used the least time, start-time fair queueing: who comes, or comes back,
// starts level with the one whose turn it was last, so nobody saves up time while he has nothing to do, and nobody is
// rid of what he used by going away for a moment. Within a client, jobs of the higher priority come first, then those
// that came first. A job that several clients wait for stands in the queue of each, and the first turn that any of them
// gets is its. Not safe for use by several threads.
class FairQueue {
 public:
  using Time = std::chrono::duration<double>;

  // client_running: turns of one client at the same time, ≥ 1. turn: how long a turn is expected to take.
  FairQueue(std::size_t client_running, Time turn) : client_running_(client_running), turn_(turn) {}

  // Lets a client wait for a job. One that waits for it already can raise its priority by that.
  void add(JobId job, const Client& client, Priority priority);
  // The client does not wait for the job any more. False if nobody does: then it is as if removed.
  bool leave(JobId job, const Client& client);
  // Nobody waits for the job any more, or it is done.
  void remove(JobId job);

  struct Turn {
    JobId job = 0;
    Client client;  // who pays
  };
  // Begins the next turn; nothing if no job waits, or only those of clients that have no turn left.
  std::optional<Turn> take();
  // Ends it: the job waits again, unless it was removed.
  void give_back(const Turn& turn, Time used);

  std::size_t waiting() const { return jobs_.size() - on_turn_.size(); }
  // Whether the client waits for this job, or it has its turn.
  bool wanted_by(const Client& client, JobId job) const;
  // Of one client.
  std::size_t waiting(const Client& client) const;
  std::size_t running(const Client& client) const;
  // Clients whose jobs wait.
  std::size_t clients_waiting() const;
  // How many jobs come before this one, if each needed one turn and nobody came; 0 if it does not wait.
  std::size_t ahead(JobId job) const;

 private:
  // In the queue of a client.
  struct Place {
    Priority priority;
    std::uint64_t order;  // of coming
    JobId job;

    std::strong_ordering operator<=>(const Place& other) const {
      if (priority != other.priority) return other.priority <=> priority;
      return order <=> other.order;
    }
    bool operator==(const Place& other) const = default;
  };
  struct Account {
    Time used{0};
    std::size_t running = 0;
    std::set<Place> waiting;

    bool idle() const { return running == 0 && waiting.empty(); }
  };
  using Accounts = std::map<Client, Account>;
  using Places = std::map<Client, Place>;

  // What a client will have used when its turns are over, as far as that is known.
  Time expected(const Account& account) const { return account.used + static_cast<double>(account.running) * turn_; }
  bool on_turn(JobId job) const { return on_turn_.contains(job); }
  std::size_t own_ahead(const Client& client, const Place& place) const;
  void wait(const Client& client, const Place& place);
  void forget_idle();

  std::size_t client_running_;
  Time turn_;
  Accounts accounts_;
  std::unordered_map<JobId, Places> jobs_;
  std::set<JobId> on_turn_;
  Time now_{0};  // what the client had used whose turn began last
  std::uint64_t came_ = 0;
};

}  // namespace kcs::jobs
