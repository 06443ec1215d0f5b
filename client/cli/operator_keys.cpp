#include "client/cli/operator_keys.h"

namespace kcs::cli {

std::optional<Order> OperatorKeys::press(char key) {
  if (asks_for_abort_) {
    asks_for_abort_ = false;
    if (key == 'y' || key == 'Y') return Order::kAbort;
    // Whoever presses hold is in a hurry: any other key is only a no.
    if (key != 'h') return std::nullopt;
  }
  switch (key) {
    case 'h':
      return Order::kHold;
    case 'r':
      return Order::kResume;
    case '-':
      return Order::kSlower;
    case '+':
    case '=':  // the same key without shift, on many keyboards
      return Order::kFaster;
    case 'a':
      asks_for_abort_ = true;
      return std::nullopt;
    case 'q':
      return Order::kLeave;
    default:
      return std::nullopt;
  }
}

std::string OperatorKeys::legend() const {
  if (asks_for_abort_) return "abort the run, which cannot be resumed then? y / n";
  return "h hold   r resume   - + override by 10 %   a abort   q leave, and let it run";
}

}  // namespace kcs::cli
