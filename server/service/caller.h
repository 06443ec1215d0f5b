// A call, as the work for it sees it.
#pragma once

#include <functional>
#include <string>

#include "server/jobs/fair_queue.h"
#include "server/security/identity.h"
#include "server/store/records.h"

namespace kcs::service {

struct Caller {
  security::Identity identity;
  jobs::Client client;     // who pays for the time that planning takes
  std::string request_id;  // of the call
  // Throws Cancelled once the client has gone, Stopping once the server ends its calls. To be called where the work
  // waits.
  std::function<void()> require_wanted;

  // Whose plans the caller may see and delete.
  store::Whose whose() const {
    if (identity.is_admin()) return std::nullopt;
    return identity.owner;
  }
};

}  // namespace kcs::service
