// What the store knows of a plan, in the words of the contract.
#pragma once

#include <kcs/v1/planning.pb.h>

#include "server/jobs/plan_work.h"
#include "server/store/records.h"

namespace kcs::service {

// state: what to say of one that has no outcome yet. Of a plan that is not READY: name, state and time alone.
v1::Plan encode_record(const store::Record& record, v1::PlanState state);

// Throws Refused if it was.
const store::Record& require_not_refused(const store::Record& record);

v1::PlanProgress encode_progress(const jobs::Progress& progress);
// Of a plan that is READY.
v1::PlanProgress encode_progress(const v1::Plan& plan);

// Throws planning::InvalidInput for numbers that the contract does not know and times that are none.
store::Filter decode_filter(const v1::PlanFilter& filter);

}  // namespace kcs::service
