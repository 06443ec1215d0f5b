// A program that is read while it may still be written.
#pragma once

#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace kcs::cli {

class IncomingProgram {
 public:
  // file: its name; "-": standard input. Throws client::FileError if it cannot be opened.
  explicit IncomingProgram(const std::string& file);
  ~IncomingProgram();
  IncomingProgram(const IncomingProgram&) = delete;
  IncomingProgram& operator=(const IncomingProgram&) = delete;

  // What there is of it, valid until the next call: waits for some of it, or until a stop is requested. Empty at the
  // end of the program. Throws client::FileError if it cannot be read.
  std::string_view next(const std::stop_token& stop);

 private:
  std::string file_;
  int descriptor_;
  std::vector<char> piece_;
};

}  // namespace kcs::cli
