// Messages of any type with random content.
#pragma once

#include <google/protobuf/message.h>

#include <random>

namespace kcs::contract {

// Gives about half of the fields a value, to some depth; the other ones stay as they are. Numbers are finite, text is
// UTF-8, and values of enums may be ones that the type has no name for.
void fill(google::protobuf::Message& message, std::mt19937_64& random, int depth = 3);

// Adds fields that no version has yet, to the message and to all within it.
void add_future_fields(google::protobuf::Message& message, std::mt19937_64& random);

}  // namespace kcs::contract
