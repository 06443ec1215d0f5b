// What two programs would no longer understand of each other if they were built from two versions of the contract.
#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <vector>

namespace kcs::contract {

// One line for each break between a released file and the contract that is to follow it: the full name of what broke,
// how, and the remedy. Stricter than the wire alone asks for: names stay too, for JSON and for sources.
std::vector<std::string> breaks(const google::protobuf::FileDescriptor& released,
                                const google::protobuf::DescriptorPool& present);

}  // namespace kcs::contract
