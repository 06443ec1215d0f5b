// The options that say which server to talk to, and who one is there; the same in every command.
#pragma once

#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace kcs::client {

struct Connection;

// Adds --server, --tls, --tls-ca, --tls-cert, --tls-key and --token-file. What they say goes to `connection`, which
// must live until `app` has read the command line. `server`: what the server is for. Returns the option --server.
CLI::Option* add_connection_options(CLI::App& app, Connection& connection, const std::string& server);

}  // namespace kcs::client
