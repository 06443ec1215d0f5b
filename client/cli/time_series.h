// A long row of samples thinned to what a picture can show, with every peak kept.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace kcs::cli {

// Divides a window of time into equal slots and keeps the smallest and the largest sample of each, in the order in
// which they came. With fewer samples than slots it keeps them all.
class TimeSeries {
 public:
  // Where the window begins and ends, s; to > from.
  TimeSeries(double from, double to, std::size_t slots);

  // Samples come in the order of time and lie inside the window.
  void add(double time, double value);

  // What was kept: time and value.
  std::vector<std::pair<double, double>> points() const;

 private:
  struct Sample {
    double time = 0;
    double value = 0;
  };
  struct Slot {
    bool used = false;
    Sample lowest;
    Sample highest;
  };

  double from_;
  double slot_length_;
  std::vector<Slot> slots_;
};

}  // namespace kcs::cli
