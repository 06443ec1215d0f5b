#include "client/cli/health.h"

#include <fmt/core.h>
#include <httplib.h>

#include "client/cli/output.h"
#include "client/sdk/error.h"

namespace kcs::cli {

void check_health(const std::string& address) {
  constexpr int kPatience = 5;  // s
  httplib::Client server("http://" + address);
  server.set_connection_timeout(kPatience);
  server.set_read_timeout(kPatience);
  const httplib::Result answer = server.Get("/readyz");
  if (!answer) {
    throw client::Error("UNAVAILABLE",
                        fmt::format("{}: no answer to /readyz ({}); does kcsd run there, with observe.http_listen?",
                                    address, httplib::to_string(answer.error())));
  }
  if (answer->status != 200)
    throw client::Error("UNAVAILABLE", fmt::format("{}: not ready: {}", address, answer->body));
  print(answer->body);
}

}  // namespace kcs::cli
