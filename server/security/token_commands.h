// What kcsd does with tokens at the command line.
#pragma once

#include <iosfwd>

namespace kcs::security {

// Writes a fresh token, and nothing else, to `out`, and its line of the configuration to `notes`.
void make_token(std::ostream& out, std::ostream& notes);

// Reads a token, the first line of `in`, and writes its line of the configuration to `out`. A token among a program's
// arguments could be seen by everybody on the machine, so it is not taken from there.
// Throws std::runtime_error if it is no token, see require_token.
void hash_token(std::istream& in, std::ostream& out);

}  // namespace kcs::security
