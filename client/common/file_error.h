// A file that cannot be read or written, or a helper program that is not there.
#pragma once

#include <stdexcept>

namespace kcs::client {

// what() names the file and the remedy.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace kcs::client
