// What a server takes of its machine, over its life.
#pragma once

#include <string>
#include <vector>

namespace kcs::soak {

struct Resources {
  double memory = 0;  // resident, bytes
  double files = 0;   // open
  int threads = 0;
};

// One life, from a server's start to its end.
class Life {
 public:
  // time: since its start, s.
  void add(double time, const Resources& resources);

  double seconds() const { return samples_.empty() ? 0 : samples_.back().time; }

  // Whether the memory grew no more after the first minute. True if the life was too short to tell.
  bool flat() const;

  // One line of the table that `header` begins.
  std::string row() const;
  static std::string header();

 private:
  struct Sample {
    double time;
    Resources resources;
  };
  // What counts: when caches are full and every kind of call was there.
  std::vector<Sample> later() const;
  bool long_enough() const;
  double growth() const;  // of the memory, bytes a minute

  std::vector<Sample> samples_;
};

}  // namespace kcs::soak
