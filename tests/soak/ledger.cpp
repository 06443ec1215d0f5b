#include "tests/soak/ledger.h"

namespace kcs::soak {

std::string content_of(const v1::Plan& plan) {
  v1::Plan content = plan;
  content.clear_state();
  content.clear_create_time();
  return content.SerializeAsString();
}

void Ledger::add(const Entry& entry) {
  const std::lock_guard lock(mutex_);
  const auto [place, added] = places_.emplace(entry.name, entries_.size());
  if (added) {
    entries_.push_back(entry);
  } else {
    entries_[place->second] = entry;
  }
}

std::optional<Entry> Ledger::any(std::mt19937_64& random) const {
  const std::lock_guard lock(mutex_);
  if (entries_.empty()) return std::nullopt;
  return entries_[std::uniform_int_distribution<std::size_t>(0, entries_.size() - 1)(random)];
}

std::optional<Entry> Ledger::take(std::mt19937_64& random) {
  const std::lock_guard lock(mutex_);
  if (entries_.empty()) return std::nullopt;
  const std::size_t place = std::uniform_int_distribution<std::size_t>(0, entries_.size() - 1)(random);
  const Entry taken = entries_[place];
  entries_[place] = entries_.back();
  places_[entries_[place].name] = place;
  entries_.pop_back();
  places_.erase(taken.name);
  return taken;
}

bool Ledger::holds(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return places_.contains(name);
}

bool Ledger::agrees(const std::string& name, const v1::Plan& plan) {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find(name);
  if (place == places_.end() || plan.state() != v1::PLAN_STATE_READY) return true;
  std::string& known = entries_[place->second].content;
  if (known.empty()) known = content_of(plan);
  return known == content_of(plan);
}

bool Ledger::agrees(const std::string& name, std::uint64_t setpoints) {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find(name);
  if (place == places_.end()) return true;
  std::optional<std::uint64_t>& known = entries_[place->second].setpoints;
  if (!known) known = setpoints;
  return *known == setpoints;
}

std::vector<Entry> Ledger::entries() const {
  const std::lock_guard lock(mutex_);
  return entries_;
}

}  // namespace kcs::soak
