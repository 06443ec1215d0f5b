// A port for a server that is to come back to the same address.
#pragma once

namespace kcs::test {

// One that nobody uses on 127.0.0.1, below those that connections get at their other end: while the server is away, a
// client that knocks there must not take the port itself. No other process that asks for one is given the same as long
// as this one lives. Throws std::runtime_error if none is found.
int free_port();

}  // namespace kcs::test
