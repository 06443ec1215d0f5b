// Between the library's structs of machines and runs and the messages of the contract. Used inside the library alone.
#pragma once

#include "client/sdk/run.h"
#include "kcs/v1/machine.pb.h"

namespace kcs::client {

AttachedMachine from_message(const v1::AttachedMachine& message);
Run from_message(const v1::Run& message);

}  // namespace kcs::client
