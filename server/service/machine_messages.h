// Between the messages of MachineService and the types of the runs.
#pragma once

#include <kcs/v1/machine.pb.h>

#include "server/service/machines.h"

namespace kcs::service {

// Throws planning::InvalidInput with all that is wrong; fills in the defaults of the contract.
runs::MachineProfile decode_hello(const v1::MachineHello& hello);

// axes: of the machine. Throws planning::InvalidInput for what cannot be.
runs::MachineReport decode_report(const v1::MachineReport& report, std::size_t axes);

v1::AttachMachineResponse encode_order(const runs::Order& order, std::size_t axes);

// machines: where the run's machine says how it is, if it is attached.
v1::Run encode_run(const runs::Run& run, const Machines& machines);
void encode_machine(const runs::Machine& machine, v1::AttachedMachine& message);

// "machines/NAME".
void check_machine_name(const std::string& field, const std::string& name);

}  // namespace kcs::service
