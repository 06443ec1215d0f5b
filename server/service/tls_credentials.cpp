#include "server/service/tls_credentials.h"

#include <grpc/grpc_security.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "server/service/listen_address.h"

namespace kcs::service {

// The certificates for one socket. gRPC asks for them at its start and whenever it has accepted a connection, one
// connection after the other.
class TlsCredentials::Source {
 public:
  explicit Source(const security::CertificateFiles& files) : files_(files) {}

  static grpc_ssl_certificate_config_reload_status fetch(void* source, grpc_ssl_server_certificate_config** config) {
    return static_cast<Source*>(source)->refresh(*config);
  }

 private:
  grpc_ssl_certificate_config_reload_status refresh(grpc_ssl_server_certificate_config*& config) {
    std::string trouble;
    try {
      security::Certificates now = security::read_certificates(files_);
      if (now == seen_) return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_UNCHANGED;
      seen_ = std::move(now);
      security::require_sound(seen_, files_);
      spdlog::info("serves with the certificate of {}", security::describe(seen_));
      config = make_config();
      return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_NEW;
    } catch (const std::exception& failure) {
      trouble = failure.what();
    }
    if (trouble != trouble_) spdlog::error("stays with the certificate that it has: {}", trouble);
    trouble_ = std::move(trouble);
    return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_UNCHANGED;
  }

  grpc_ssl_server_certificate_config* make_config() const {
    const grpc_ssl_pem_key_cert_pair pair{seen_.key.c_str(), seen_.certificate.c_str()};
    // gRPC wants client roots even where it asks for no client's certificate.
    const std::string& roots = files_.client_ca.empty() ? seen_.certificate : seen_.client_ca;
    return grpc_ssl_server_certificate_config_create(roots.c_str(), &pair, 1);
  }

  const security::CertificateFiles& files_;
  security::Certificates seen_;  // sound or not
  std::string trouble_;          // that was reported last
};

TlsCredentials::TlsCredentials(security::CertificateFiles files) : files_(std::move(files)) {
  security::require_sound(security::read_certificates(files_), files_);
}

TlsCredentials::~TlsCredentials() = default;

// Each socket has credentials of its own: gRPC accepts connections of one socket one after the other, but those of two
// at the same time, and does not guard the replacement of a certificate against that.
int TlsCredentials::AddPortToServer(const std::string& address, grpc_server* server) {
  const auto request = files_.client_ca.empty() ? GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE
                                                : GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY;
  int port = 0;
  for (const SocketAddress& socket : socket_addresses(address)) {
    grpc_server_credentials* credentials =
        grpc_ssl_server_credentials_create_with_options(grpc_ssl_server_credentials_create_options_using_config_fetcher(
            request, &Source::fetch, &sources_.emplace_back(files_)));
    // Port 0 takes any free one, but the same for all sockets.
    const std::string text =
        port == 0 ? socket.text : socket.text.substr(0, socket.text.rfind(':') + 1) + std::to_string(port);
    port = std::max(port, grpc_server_add_http2_port(server, text.c_str(), credentials));
    grpc_server_credentials_release(credentials);
  }
  return port;
}

}  // namespace kcs::service
