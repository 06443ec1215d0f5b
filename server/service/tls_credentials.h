// TLS for a listening socket.
#pragma once

#include <grpcpp/security/server_credentials.h>

#include <deque>
#include <memory>
#include <string>

#include "server/security/certificates.h"

namespace kcs::service {

// Certificate, key and client roots come from files, which are looked at again for every new connection: whoever
// replaces them need not restart the server, and the connections that are open go on. Files that are not sound (half
// written, of two different certificates) are reported in the log, and those from before stay in use. gRPC's own
// watcher of files has no such check: with a wrong pair it turns new connections away until there is a right one.
//
// TLS 1.2 at least. With client roots, clients without a valid certificate are turned away.
class TlsCredentials final : public grpc::ServerCredentials {
 public:
  // Throws std::runtime_error if the files cannot be read or are not sound.
  explicit TlsCredentials(security::CertificateFiles files);
  ~TlsCredentials() override;  // after the server that uses it
  TlsCredentials(const TlsCredentials&) = delete;
  TlsCredentials& operator=(const TlsCredentials&) = delete;

  // Without effect: callers are known by what comes with each call, also where there is no TLS.
  void SetAuthMetadataProcessor(const std::shared_ptr<grpc::AuthMetadataProcessor>& /*processor*/) override {}

 private:
  class Source;

  int AddPortToServer(const std::string& address, grpc_server* server) override;

  const security::CertificateFiles files_;
  std::deque<Source> sources_;  // one for each socket
};

}  // namespace kcs::service
