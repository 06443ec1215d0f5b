// Whether a server keeps what was promised.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/soak/ledger.h"
#include "tests/soak/tally.h"

namespace kcs::soak {

struct Verdict {
  int acknowledged = 0;
  int lost = 0;      // not there, not in the list or never made
  int changed = 0;   // there, but another summary or other setpoints
  int streamed = 0;  // of which the setpoints were compared
};

// Asks for every plan of the ledger, by its name and in the list, and for the setpoints of some that were streamed
// before. What is not yet made is waited for.
Verdict verify(const std::string& address, const Ledger& ledger, Tally& tally);

}  // namespace kcs::soak
