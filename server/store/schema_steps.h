// What leads from each version of the tables to the next, and back.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "server/store/dialect.h"
#include "server/store/schema_command.h"

namespace kcs::store {

struct SchemaStep {
  std::vector<std::string> forward;  // SQL
  std::vector<std::string> back;     // none of the first: a store without tables is none
  std::string lost;                  // by going back; empty: nothing
};

// The step at index i makes version i + 1. One that was released never changes: a new one is added.
//
// While a cluster is upgraded, servers of the version before work on the new tables. So a step only adds what they need
// not know: tables, indexes, columns with a default. Where that is not enough, the step sets usable_from in kcs_schema
// to its own version, and back to what it was: older servers then refuse to start, and all have to be stopped first.
std::array<SchemaStep, kSchemaVersion> schema_steps(const Dialect& dialect);

}  // namespace kcs::store
