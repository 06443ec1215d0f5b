// The keys of the view of a run.
#pragma once

#include <optional>
#include <string>

namespace kcs::cli {

enum class Order { kHold, kResume, kSlower, kFaster, kAbort, kLeave };

// What the keys mean, one after the other: an abort is asked for twice.
class OperatorKeys {
 public:
  // Nothing if the key means nothing, or is to be confirmed.
  std::optional<Order> press(char key);

  // Which keys there are now; what is to be confirmed.
  std::string legend() const;

 private:
  bool asks_for_abort_ = false;
};

}  // namespace kcs::cli
