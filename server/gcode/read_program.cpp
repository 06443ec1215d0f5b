#include "server/gcode/read_program.h"

#include <array>
#include <string_view>

#include "server/gcode/reader.h"

namespace kcs::gcode {
namespace {

constexpr std::size_t kPieceBytes = 65536;

}  // namespace

Program read_program(std::istream& program, const Options& options) {
  Program read{.path = {{.start = options.start}}};
  Reader reader(options, [&read](const planning::Segment& segment) { read.path.segments.push_back(segment); });
  std::array<char, kPieceBytes> piece;
  while (program) {
    program.read(piece.data(), piece.size());
    reader.read(std::string_view(piece.data(), static_cast<std::size_t>(program.gcount())));
  }
  if (program.bad()) throw std::ios_base::failure("the program cannot be read to its end");
  reader.finish();
  read.notices = reader.notices();
  read.largest_chord_error = reader.largest_chord_error();
  return read;
}

}  // namespace kcs::gcode
