// A configuration file of kcsd for one test.
#pragma once

#include <string>

#include "tests/files/temporary_folder.h"

namespace kcs::test {

// Gone with this object: kcsd reads it when it starts.
class ConfigFile {
 public:
  explicit ConfigFile(const std::string& text) : path_(folder_.write("kcsd.toml", text)) {}

  const std::string& path() const { return path_; }

 private:
  const TemporaryFolder folder_;
  const std::string path_;
};

}  // namespace kcs::test
