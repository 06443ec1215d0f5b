#include "client/sdk/token_credentials.h"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <map>
#include <string>
#include <utility>

#include "client/sdk/error.h"
#include "client/sdk/text_file.h"

namespace kcs::client {
namespace {

std::string read_token(const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  std::string token = text.substr(0, text.find_first_of("\r\n"));
  const auto is_visible = [](char character) { return character > ' ' && character < '\x7f'; };
  if (token.empty() || !std::all_of(token.begin(), token.end(), is_visible)) {
    throw Error("INVALID_ARGUMENT", fmt::format("{}: must hold a token in its first line", file.string()));
  }
  return token;
}

class TokenFromFile final : public grpc::MetadataCredentialsPlugin {
 public:
  explicit TokenFromFile(std::filesystem::path file) : file_(std::move(file)) {}

  grpc::Status GetMetadata(grpc::string_ref /*service_url*/, grpc::string_ref /*method_name*/,
                           const grpc::AuthContext& /*channel*/,
                           std::multimap<std::string, std::string>* metadata) override {
    try {
      metadata->emplace("authorization", "Bearer " + read_token(file_));
      return grpc::Status::OK;
    } catch (const std::exception& failure) {
      return {grpc::StatusCode::UNAVAILABLE, failure.what()};  // it may be about to be replaced
    }
  }

 private:
  std::filesystem::path file_;
};

}  // namespace

std::shared_ptr<grpc::CallCredentials> token_credentials(const std::filesystem::path& file, bool needs_tls) {
  read_token(file);
  return grpc::experimental::MetadataCredentialsFromPlugin(std::make_unique<TokenFromFile>(file),
                                                           needs_tls ? GRPC_PRIVACY_AND_INTEGRITY : GRPC_SECURITY_NONE);
}

}  // namespace kcs::client
