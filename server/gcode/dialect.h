// The languages of other controls, recognised by words that RS-274 does not have.
#pragma once

#include <optional>
#include <string_view>

namespace kcs::gcode {

// What to tell the author of a line that was refused and that seems to be written for another control: which one, and
// how the same is written for kcs. Nothing for a line that could be any RS-274.
std::optional<std::string_view> hint_on_dialect(std::string_view line);

}  // namespace kcs::gcode
