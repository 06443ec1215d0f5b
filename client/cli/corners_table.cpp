#include "client/cli/corners_table.h"

#include <fmt/format.h>

#include <iterator>

#include "client/cli/numbers.h"
#include "client/common/names.h"

namespace kcs::cli {

std::string corners_table(const std::vector<client::Corner>& corners) {
  static constexpr fmt::string_view kRow = "{:>9}{:>9}{:>8}  {:<13}{:>10}{:>10}{:>10}{:>9}\n";
  std::string text = fmt::format(kRow, "segment", "line", "angle", "strategy", "speed", "duration", "cut", "lost") +
                     fmt::format(kRow, "", "", "°", "", "mm/s", "ms", "µm", "ms");
  for (const client::Corner& corner : corners) {
    fmt::format_to(std::back_inserter(text), kRow, corner.segment, corner.line, decimal(corner.angle_deg, 2),
                   name_of(corner.strategy), decimal(corner.speed_mm_s, 2), decimal(1e3 * corner.duration_s, 2),
                   decimal(1e3 * corner.deviation_mm, 2), decimal(1e3 * corner.time_lost_s, 2));
  }
  return text;
}

}  // namespace kcs::cli
