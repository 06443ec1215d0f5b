#include "client/cli/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <ostream>
#include <string_view>
#include <utility>

#include "client/common/file_error.h"

namespace kcs::cli {

std::string csv_header(std::size_t axes, const std::vector<client::Channel>& channels) {
  static constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  static constexpr std::array<std::pair<client::Channel, std::string_view>, 3> kPrefixes = {
      {{client::Channel::kVelocity, "v"}, {client::Channel::kAcceleration, "a"}, {client::Channel::kJerk, "j"}}};
  const auto has = [&](client::Channel channel) {
    return std::find(channels.begin(), channels.end(), channel) != channels.end();
  };
  std::string header = "t";
  for (std::size_t axis = 0; axis < axes; ++axis) header += fmt::format(",{}", kAxes.at(axis));
  for (const auto& [channel, prefix] : kPrefixes) {
    for (std::size_t axis = 0; has(channel) && axis < axes; ++axis) {
      header += fmt::format(",{}{}", prefix, kAxes.at(axis));
    }
  }
  if (has(client::Channel::kPathPosition)) header += ",path_position";
  if (has(client::Channel::kSegment)) header += ",segment";
  return header + "\n";
}

std::string csv_rows(const client::SetpointBatch& batch, double period_s) {
  std::string rows;
  for (std::size_t row = 0; row < batch.size(); ++row) {
    fmt::format_to(std::back_inserter(rows), "{:.15g}", static_cast<double>(batch.first_index + row) * period_s);
    for (const client::Columns* columns :
         {&batch.position_mm, &batch.velocity_mm_s, &batch.acceleration_mm_s2, &batch.jerk_mm_s3}) {
      for (const std::vector<double>& column : *columns) {
        fmt::format_to(std::back_inserter(rows), ",{:.15g}", column[row]);
      }
    }
    if (!batch.path_position_mm.empty()) {
      fmt::format_to(std::back_inserter(rows), ",{:.15g}", batch.path_position_mm[row]);
    }
    if (!batch.segment.empty()) fmt::format_to(std::back_inserter(rows), ",{}", batch.segment[row]);
    rows += '\n';
  }
  return rows;
}

void write_csv(client::SetpointStream& stream, std::size_t axes, const client::StreamOptions& options,
               std::ostream& out, const std::function<void(const client::SetpointBatch&)>& progress) {
  out << csv_header(axes, options.channels);
  for (client::SetpointBatch batch; stream.next(batch);) {
    out << csv_rows(batch, options.period_s);
    if (!out) break;
    progress(batch);
  }
  if (!out.flush()) throw client::FileError("the setpoints cannot be written; is the disk full?");
}

}  // namespace kcs::cli
