// Which kcs this is.
#pragma once

#include <string_view>

namespace kcs {

// The release: "0.1.0".
std::string_view version();
// What was built of it: the commit, with "-dirty" if files differed from it. "unknown" where there was no checkout and
// whoever built it did not say (cmake -DKCS_BUILD=NAME).
std::string_view build();
// Both, for a person: "0.1.0 (build 57a064896d5a)".
std::string_view version_and_build();

}  // namespace kcs
