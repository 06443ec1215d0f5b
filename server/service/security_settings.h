// The tables [security], [[tokens]] and [[certificates]] of the configuration.
#pragma once

#include <string>
#include <vector>

#include "server/service/security.h"
#include "server/service/settings_file.h"

namespace kcs::service {

// All three, by their names.
Keys security_tables(SecuritySettings& settings);

// The tokens in the text of a tokens file. Throws std::runtime_error that starts with "FILE:LINE:".
std::vector<security::KnownToken> parse_tokens(const std::string& text, const std::string& file);

}  // namespace kcs::service
