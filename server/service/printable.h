// Text of unknown origin, made fit for messages and logs.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace kcs::service {

// `text` as it may stand in a protobuf string, a status message or a line of a log: bytes that are not UTF-8 and
// control characters become "?", and what is longer than `most` bytes is cut.
std::string printable(std::string_view text, std::size_t most);

}  // namespace kcs::service
