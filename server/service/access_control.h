// Who calls, by the token or the certificate that comes with the call.
#pragma once

#include <grpcpp/server_context.h>

#include <memory>
#include <string_view>
#include <vector>

#include "server/security/identity.h"
#include "server/service/security.h"
#include "server/service/tokens_file.h"

namespace kcs::service {

// Safe for use by many threads at once.
class AccessControl {
 public:
  // Throws std::runtime_error, with the place, if the file of tokens cannot be read.
  explicit AccessControl(const SecuritySettings& settings);

  // The caller that the call's token stands for ("authorization: Bearer TOKEN"), or else the certificate of its
  // connection. Throws Unauthenticated if there is neither, or an unknown one.
  security::Identity authenticate(const grpc::ServerContext& context) const;

  // The same, of a caller who may call this method of the service. Throws Forbidden if he may not.
  security::Identity admit(const grpc::ServerContext& context, std::string_view method) const;

 private:
  security::Identity caller_of_token(std::string_view token) const;

  const bool tells_callers_apart_;
  const std::vector<security::KnownToken> tokens_;
  const std::unique_ptr<TokensFile> tokens_file_;  // none if there is no such file
  const std::vector<security::KnownCertificate> certificates_;
};

}  // namespace kcs::service
