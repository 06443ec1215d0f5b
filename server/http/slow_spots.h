// Where a program loses time, gathered while its corners come.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace kcs::http {

// The lines of a program whose corners cost most. Memory: that of ten spots.
class SlowSpots {
 public:
  // The next corner, in the order of the path.
  void add(const v1::Corner& corner);

  // After the last one: the ten that lose most time, the worst first; spots that lose none are left out.
  nlohmann::ordered_json finish();

 private:
  // The corners that one line makes one after the other.
  struct Spot {
    v1::Corner worst;
    std::size_t corners = 0;
    double time_lost = 0;  // s, by all of them
  };

  void settle();

  std::optional<Spot> current_;
  std::vector<Spot> slowest_;  // the worst first
};

}  // namespace kcs::http
