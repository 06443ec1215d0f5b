#include "client/cli/output.h"

#include <iostream>

#include "client/common/file_error.h"

namespace kcs::cli {

void print(const std::string& text) {
  if (!(std::cout << text << std::flush))
    throw client::FileError("standard output cannot be written; is the disk full?");
}

}  // namespace kcs::cli
