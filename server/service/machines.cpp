#include "server/service/machines.h"

#include <algorithm>
#include <chrono>

#include "server/jobs/cap_exceeded.h"
#include "server/service/gate.h"
#include "server/service/status.h"

namespace kcs::service {
namespace {

// For a superseded attachment to end.
constexpr std::chrono::seconds kFarewell{1};

}  // namespace

Machines::Attachment::Attachment(Machines& machines, const runs::MachineProfile& profile, const std::string& instance,
                                 const runs::MachineReport& first)
    : machines_(machines) {
  std::unique_lock lock(machines_.mutex_);
  const auto is_attached = [&] {
    const auto place = machines_.places_.find(profile.name);
    return place != machines_.places_.end() && place->second.attached;
  };
  if (is_attached() && !instance.empty() && machines_.places_[profile.name].instance == instance) {
    machines_.places_[profile.name].superseded = true;
    machines_.detached_.wait_for(lock, kFarewell, [&] { return !is_attached(); });
  }
  if (is_attached()) {
    throw AlreadyAttached(profile.name +
                          " is attached by another gateway: stop that one, or give this machine a name "
                          "of its own");
  }
  if (machines_.attached() >= machines_.most_) {
    throw jobs::CapExceeded("machines", machines_.most_, "detach one, or attach to another server", kGateRetry);
  }
  Place& place = machines_.places_[profile.name];  // not before: names that are refused are not kept
  place.attached = true;
  place.superseded = false;
  place.instance = instance;
  const bool same = place.machine != nullptr && place.machine->profile() == profile;
  if (!same) place.machine = std::make_shared<runs::Machine>(profile);
  machine_ = place.machine;
  machine_->attach(first);
}

Machines::Attachment::~Attachment() {
  const std::lock_guard lock(machines_.mutex_);
  const auto place = machines_.places_.find(machine_->profile().name);
  place->second.attached = false;
  if (!machine_->has_open_run()) machines_.places_.erase(place);
  machines_.detached_.notify_all();
}

bool Machines::Attachment::superseded() const {
  const std::lock_guard lock(machines_.mutex_);
  return machines_.places_.at(machine_->profile().name).superseded;
}

std::uint64_t Machines::attached() const {
  return static_cast<std::uint64_t>(
      std::count_if(places_.begin(), places_.end(), [](const auto& place) { return place.second.attached; }));
}

Machines::MachinePointer Machines::try_find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find(name);
  return place != places_.end() && place->second.attached ? place->second.machine : nullptr;
}

Machines::MachinePointer Machines::find(const std::string& name) const {
  MachinePointer machine = try_find(name);
  if (machine == nullptr) throw NotAttached(name);
  return machine;
}

Machines::MachinePointer Machines::machine_of(const std::string& run) const {
  return find(run.substr(0, run.find("/runs/")));
}

std::vector<Machines::MachinePointer> Machines::all() const {
  const std::lock_guard lock(mutex_);
  std::vector<MachinePointer> machines;
  for (const auto& [name, place] : places_) {
    if (place.attached) machines.push_back(place.machine);
  }
  return machines;
}

}  // namespace kcs::service
