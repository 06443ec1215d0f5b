#include "client/cli/setpoint_writer.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "client/cli/csv.h"
#include "client/cli/npy.h"

namespace kcs::cli {

using client::Channel;

SetpointFormat format_of(const std::string& file) {
  if (file.ends_with(".npy")) return SetpointFormat::kNumPy;
  if (file.ends_with(".hal")) return SetpointFormat::kStreamer;
  return SetpointFormat::kCsv;
}

std::vector<std::string> SetpointColumns::names() const {
  static constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  static constexpr std::array<std::pair<Channel, std::string_view>, 3> kPrefixes = {
      {{Channel::kVelocity, "v"}, {Channel::kAcceleration, "a"}, {Channel::kJerk, "j"}}};
  const auto has = [this](Channel channel) {
    return std::find(channels.begin(), channels.end(), channel) != channels.end();
  };
  std::vector<std::string> names = {"t"};
  const auto add_axes = [&](std::string_view prefix) {
    for (std::size_t axis = 0; axis < axes; ++axis) names.push_back(std::string(prefix).append(kAxes.at(axis)));
  };
  add_axes("");
  for (const auto& [channel, prefix] : kPrefixes) {
    if (has(channel)) add_axes(prefix);
  }
  if (has(Channel::kPathPosition)) names.emplace_back("path_position");
  if (has(Channel::kSegment)) names.emplace_back("segment");
  if (has(Channel::kLine)) names.emplace_back("line");
  return names;
}

std::unique_ptr<SetpointWriter> make_writer(SetpointFormat format, const SetpointColumns& columns, std::ostream& out) {
  switch (format) {
    case SetpointFormat::kNumPy:
      return std::make_unique<NpyWriter>(columns, out);
    case SetpointFormat::kStreamer:
      return std::make_unique<StreamerWriter>(out);
    default:
      return std::make_unique<CsvWriter>(columns, out);
  }
}

}  // namespace kcs::cli
