// What the server has promised to keep.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <unordered_map>
#include <vector>

#include "tests/soak/recipe.h"

namespace kcs::soak {

// A plan whose CreatePlan was answered OK.
struct Entry {
  std::string name;
  Recipe recipe;
  std::string content;                     // see content_of(); empty until it was seen READY
  std::optional<std::uint64_t> setpoints;  // digest of its setpoints, once they were streamed
};

// Everything that a plan says of its path.
std::string content_of(const v1::Plan& plan);

// Safe for use by many threads at once. A plan that somebody deletes, or asks for again, is taken out meanwhile, so
// that what is in the ledger is kept for certain.
class Ledger {
 public:
  void add(const Entry& entry);

  // Some entry, which stays; or which goes, to be added again if it is still kept. Nothing if there is none.
  std::optional<Entry> any(std::mt19937_64& random) const;
  std::optional<Entry> take(std::mt19937_64& random);

  // Whether it is kept for certain, at this moment.
  bool holds(const std::string& name) const;

  // What was seen of it now: false if it is not what was seen before. True if it is not in the ledger.
  bool agrees(const std::string& name, const v1::Plan& plan);
  bool agrees(const std::string& name, std::uint64_t setpoints);

  std::vector<Entry> entries() const;

 private:
  mutable std::mutex mutex_;
  std::vector<Entry> entries_;
  std::unordered_map<std::string, std::size_t> places_;  // by name
};

}  // namespace kcs::soak
