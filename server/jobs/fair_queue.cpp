#include "server/jobs/fair_queue.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace kcs::jobs {

void FairQueue::add(JobId job, const Client& client, Priority priority) {
  const auto [entry, is_new] = jobs_[job].try_emplace(client, Place{priority, came_, job});
  Place& place = entry->second;
  if (is_new) {
    ++came_;
  } else {
    if (place.priority >= priority) return;
    if (!on_turn(job)) accounts_.at(client).waiting.erase(place);
    place.priority = priority;
  }
  if (!on_turn(job)) wait(client, place);
}

bool FairQueue::leave(JobId job, const Client& client) {
  const auto found = jobs_.find(job);
  if (found == jobs_.end()) return false;
  Places& places = found->second;
  if (const auto place = places.find(client); place != places.end()) {
    if (!on_turn(job)) accounts_.at(client).waiting.erase(place->second);
    places.erase(place);
  }
  const bool wanted = !places.empty();
  if (!wanted) remove(job);
  forget_idle();
  return wanted;
}

void FairQueue::remove(JobId job) {
  const auto found = jobs_.find(job);
  if (found == jobs_.end()) return;
  if (on_turn_.erase(job) == 0) {
    for (const auto& [client, place] : found->second) accounts_.at(client).waiting.erase(place);
  }
  jobs_.erase(found);
  forget_idle();
}

std::optional<FairQueue::Turn> FairQueue::take() {
  const auto rank = [this](const Account& account) {
    return std::pair(expected(account), account.waiting.begin()->order);
  };
  auto next = accounts_.end();
  for (auto it = accounts_.begin(); it != accounts_.end(); ++it) {
    if (it->second.waiting.empty() || it->second.running >= client_running_) continue;
    if (next == accounts_.end() || rank(it->second) < rank(next->second)) next = it;
  }
  if (next == accounts_.end()) return {};
  auto& [client, account] = *next;
  const JobId job = account.waiting.begin()->job;
  for (const auto& [waiting, place] : jobs_.at(job)) accounts_.at(waiting).waiting.erase(place);
  on_turn_.insert(job);
  now_ = std::max(now_, account.used);
  ++account.running;
  return Turn{job, client};
}

void FairQueue::give_back(const Turn& turn, Time used) {
  Account& account = accounts_.at(turn.client);
  account.used += used;
  --account.running;
  if (on_turn_.erase(turn.job) > 0) {
    for (const auto& [client, place] : jobs_.at(turn.job)) wait(client, place);
  }
  forget_idle();
}

void FairQueue::wait(const Client& client, const Place& place) {
  Account& account = accounts_[client];
  if (account.idle()) account.used = std::max(account.used, now_);
  account.waiting.insert(place);
}

// Whose account is level with that of a newcomer, or everybody's if there is nobody to be compared with.
void FairQueue::forget_idle() {
  std::erase_if(accounts_, [this](const auto& entry) {
    return entry.second.idle() && (jobs_.empty() || entry.second.used <= now_);
  });
}

bool FairQueue::wanted_by(const Client& client, JobId job) const {
  const auto found = jobs_.find(job);
  return found != jobs_.end() && found->second.contains(client);
}

std::size_t FairQueue::waiting(const Client& client) const {
  const auto account = accounts_.find(client);
  return account == accounts_.end() ? 0 : account->second.waiting.size();
}

std::size_t FairQueue::running(const Client& client) const {
  const auto account = accounts_.find(client);
  return account == accounts_.end() ? 0 : account->second.running;
}

std::size_t FairQueue::clients_waiting() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(accounts_, [](const auto& entry) { return !entry.second.waiting.empty(); }));
}

std::size_t FairQueue::ahead(JobId job) const {
  const auto found = jobs_.find(job);
  if (found == jobs_.end() || on_turn(job)) return 0;
  std::size_t least = jobs_.size();
  for (const auto& [client, place] : found->second) {
    const std::size_t own = own_ahead(client, place);
    std::size_t all = own;
    for (const auto& [other, account] : accounts_) {
      if (other == client) continue;
      const bool goes_first = account.used < accounts_.at(client).used;
      all += std::min(account.waiting.size(), own + (goes_first ? 1 : 0));
    }
    least = std::min(least, all);
  }
  return least;
}

// Those that have a turn as well: it need not be their last one.
std::size_t FairQueue::own_ahead(const Client& client, const Place& place) const {
  const auto& waiting = accounts_.at(client).waiting;
  const auto on_turn = std::ranges::count_if(on_turn_, [&](JobId job) {
    const Places& places = jobs_.at(job);
    const auto own = places.find(client);
    return own != places.end() && own->second < place;
  });
  return static_cast<std::size_t>(std::distance(waiting.begin(), waiting.find(place)) + on_turn);
}

}  // namespace kcs::jobs
