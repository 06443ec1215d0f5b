// A file of settings that cannot be used.
#pragma once

#include <stdexcept>

namespace kcs::client {

// what() reads "FILE:LINE:COLUMN: key: what is wrong and what to do".
class SettingsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace kcs::client
