#include "server/service/tokens_file.h"

#include <spdlog/spdlog.h>

#include <stdexcept>
#include <utility>

#include "server/security/file_content.h"
#include "server/service/security_settings.h"

namespace kcs::service {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{500};

}  // namespace

TokensFile::TokensFile(std::string file) : file_(std::move(file)) { read(); }

TokensFile::Tokens TokensFile::tokens() {
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (now < next_look_) return tokens_;
  next_look_ = now + kBetweenLooks;
  std::string trouble;
  try {
    read();
  } catch (const std::runtime_error& failure) {
    trouble = failure.what();
    if (trouble != trouble_) spdlog::error("stays with the tokens that it has: {}", trouble);
  }
  trouble_ = std::move(trouble);
  return tokens_;
}

void TokensFile::read() {
  std::string text = security::file_content(file_);
  if (tokens_ != nullptr && text == text_) return;
  text_ = std::move(text);
  tokens_ = std::make_shared<const std::vector<security::KnownToken>>(parse_tokens(text_, file_));
  spdlog::info("{}: valid tokens: {}", file_, tokens_->size());
}

}  // namespace kcs::service
