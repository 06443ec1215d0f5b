#include "tests/rs274/reference.h"

#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>

#include "tests/system/child_process.h"

namespace kcs::test {
namespace {

constexpr const char* kPython = "/usr/bin/python3";  // for which LinuxCNC's modules are installed

planning::Vector read_point(std::istream& from) {
  planning::Vector point;
  from >> point.x() >> point.y() >> point.z();
  return point;
}

void read(const std::string& text, Reference& reference) {
  std::istringstream words(text);
  std::string kind;
  words >> kind;
  if (kind != "line" && kind != "arc") {
    if (reference.obstacle.empty()) reference.obstacle = text;
    return;
  }
  Move move;
  words >> move.line;
  move.end = read_point(words);
  if (kind == "arc") {
    move.centre = read_point(words);
    words >> move.normal >> move.turns;
  }
  if (!words) throw std::runtime_error("cannot read the reference's line: " + text);
  reference.moves.push_back(move);
}

}  // namespace

std::string why_no_reference() {
  return run({kPython, "-c", "import gcode"}).exit_code == 0
             ? ""
             : "LinuxCNC's interpreter is not installed (Debian's linuxcnc-uspace); ./run test rs274 installs it";
}

Reference reference_of(const std::string& file) {
  Reference reference;
  ChildProcess interpreter({kPython, KCS_CANONICAL_MOVES, file});
  for (std::string line = interpreter.read_line(); !line.empty(); line = interpreter.read_line()) {
    read(line, reference);
  }
  const int code = interpreter.wait();
  if (code != 0) throw std::runtime_error("the reference ended with " + std::to_string(code) + " on " + file);
  return reference;
}

std::vector<std::string> programs_of_linuxcnc() {
  std::set<std::string> programs;  // several names may lead to one file
  ChildProcess list({"/usr/bin/dpkg-query", "-L", "linuxcnc-uspace"});
  for (std::string file = list.read_line(); !file.empty(); file = list.read_line()) {
    if (!file.ends_with(".ngc") || !std::filesystem::is_regular_file(file)) continue;
    programs.insert(std::filesystem::canonical(file).string());
  }
  return {programs.begin(), programs.end()};
}

}  // namespace kcs::test
