#include "client/common/connection_options.h"

#include <CLI/CLI.hpp>
#include <filesystem>

#include "client/sdk/connection.h"

namespace kcs::client {

CLI::Option* add_connection_options(CLI::App& app, Connection& connection, const std::string& server) {
  CLI::Option* address = app.add_option("--server", connection.address, server)->option_text("HOST:PORT");
  app.add_flag("--tls", connection.tls, "speak TLS with the server")->needs(address)->option_text(" ");
  // Whoever names a certificate wants TLS.
  const auto add_file = [&](const char* name, std::filesystem::path& file, const char* description) {
    return app
        .add_option_function<std::string>(
            name,
            [&connection, &file](const std::string& value) {
              file = value;
              connection.tls = true;
            },
            description)
        ->needs(address)
        ->option_text("FILE.pem");
  };
  add_file("--tls-ca", connection.ca_file,
           "TLS, with a server whose certificate comes from one\nof these (default: the system's roots)");
  CLI::Option* certificate =
      add_file("--tls-cert", connection.certificate_file, "TLS, and show this certificate to the server");
  CLI::Option* key = add_file("--tls-key", connection.key_file, "the key of that certificate");
  certificate->needs(key);
  key->needs(certificate);
  app.add_option("--token-file", connection.token_file,
                 "file with the token that the server wants (default:\nthe one that KCS_TOKEN_FILE names)")
      ->envname("KCS_TOKEN_FILE")
      ->option_text("FILE");
  return address;
}

}  // namespace kcs::client
