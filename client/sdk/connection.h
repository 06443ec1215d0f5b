// How to reach a server, and who one is there.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace kcs::client {

struct Connection {
  std::string address;  // "HOST:PORT" or "unix:/path/of/socket"

  // Whether to speak TLS. The server's certificate must be issued for HOST.
  bool tls = false;
  std::filesystem::path ca_file;  // PEM, the roots that the server's certificate must come from; empty: the system's
  // PEM, this client's own certificate (with those between it and the root) and its key, for servers that ask for one.
  // Both or neither.
  std::filesystem::path certificate_file;
  std::filesystem::path key_file;

  // Holds the token that says who calls; empty: none. Read anew for each call, so that the token may be exchanged. It
  // is sent only where nobody can listen: over TLS, and to a server on this machine.
  std::filesystem::path token_file;

  // Each call gives up after this time if no server can be reached.
  std::chrono::milliseconds patience = std::chrono::seconds(5);

  // Whether calls that are safe to repeat are, some times within seconds, where their server goes away meanwhile: none
  // that deletes a plan or moves a machine. False for who does so himself, at his own times.
  bool tries_again = true;
};

}  // namespace kcs::client
