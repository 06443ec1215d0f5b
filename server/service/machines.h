// The machines that gateways have attached to this server.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/runs/machine.h"

namespace kcs::service {

// Safe for use by many threads at once.
class Machines {
 public:
  using MachinePointer = std::shared_ptr<runs::Machine>;

  // most: caps.machines.
  explicit Machines(std::uint64_t most) : most_(most) {}

  // A machine that is attached, for as long as this lives.
  class Attachment {
   public:
    // instance: of the gateway's process. If the machine is attached by the same one already, that attachment is
    // superseded, and ends first. Throws AlreadyAttached, jobs::CapExceeded.
    Attachment(Machines& machines, const runs::MachineProfile& profile, const std::string& instance,
               const runs::MachineReport& first);
    ~Attachment();
    Attachment(const Attachment&) = delete;
    Attachment& operator=(const Attachment&) = delete;

    runs::Machine& machine() const { return *machine_; }
    // It is to end: the gateway has come anew.
    bool superseded() const;

   private:
    Machines& machines_;
    MachinePointer machine_;
  };

  // Null if it is not attached.
  MachinePointer try_find(const std::string& name) const;
  // Throws NotAttached.
  MachinePointer find(const std::string& name) const;
  // The machine of "machines/NAME/runs/NUMBER".
  MachinePointer machine_of(const std::string& run) const;
  std::vector<MachinePointer> all() const;

 private:
  // One that is not attached is kept while it has a run: it comes back to it.
  struct Place {
    MachinePointer machine;
    bool attached = false, superseded = false;
    std::string instance;
  };

  std::uint64_t attached() const;

  const std::uint64_t most_;
  mutable std::mutex mutex_;
  std::condition_variable detached_;
  std::map<std::string, Place> places_;
};

}  // namespace kcs::service
