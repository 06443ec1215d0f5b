#include "server/service/security.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <stdexcept>

#include "server/service/listen_address.h"

namespace kcs::service {
namespace {

void require_consistent(const SecuritySettings& settings) {
  const security::CertificateFiles& tls = settings.tls;
  if (tls.certificate.empty() != tls.key.empty()) {
    throw std::runtime_error("security.certificate and security.key go together: give both, or neither");
  }
  if (!tls.client_ca.empty() && tls.certificate.empty()) {
    throw std::runtime_error("security.client_ca needs TLS: give security.certificate and security.key too");
  }
  if (!settings.certificates.empty() && tls.client_ca.empty()) {
    throw std::runtime_error(
        "[[certificates]] need security.client_ca: give the file of those who issued them, or clients show none");
  }
}

bool only_this_machine_reaches(const std::string& listen) {
  if (listen.empty()) return true;
  const std::vector<SocketAddress> sockets = socket_addresses(listen);
  return std::all_of(sockets.begin(), sockets.end(), [](const SocketAddress& socket) { return socket.local; });
}

}  // namespace

void require_safe(const SecuritySettings& settings, const std::string& listen) {
  require_consistent(settings);
  const bool plain = settings.tls.certificate.empty();
  const bool open = !settings.tells_callers_apart() && settings.tls.client_ca.empty();
  if (only_this_machine_reaches(listen) || (!plain && !open)) return;
  if (settings.insecure) {
    spdlog::warn("listens on {} {}, as it was told to: only for a network that you trust", listen,
                 plain ? "without TLS" : "to everybody");
    return;
  }
  if (plain) {
    throw std::runtime_error("does not listen on " + listen +
                             " without TLS: everybody on the network could read and change what is sent. Give "
                             "security.certificate and security.key, or listen on 127.0.0.1 or unix:PATH; in a network "
                             "that you trust say --insecure");
  }
  throw std::runtime_error("does not listen on " + listen +
                           " to everybody: name the callers by [[tokens]] or security.tokens_file, or those who issue "
                           "their certificates by security.client_ca; in a network that you trust say --insecure");
}

}  // namespace kcs::service
