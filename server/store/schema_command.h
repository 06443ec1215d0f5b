// The version of the tables, and what kcsd does with it at the command line.
#pragma once

#include <iosfwd>

#include "server/store/settings.h"

namespace kcs::store {

// Of the tables that this kcsd makes.
constexpr int kSchemaVersion = 3;

// Brings the tables of the store to this version, 1 to kSchemaVersion, forward or back, and writes to `out` what it did
// and what is lost; all or nothing of it. Back is for an older kcsd that refuses the newer tables. Throws StoreError if
// there is no such version, if there are no tables or those of a newer kcsd, or if other kcsd have the store open and
// would lose what they use, StoreUnavailable if the database does not answer.
void change_schema(const StoreSettings& settings, int version, std::ostream& out);

}  // namespace kcs::store
