#include "client/gateway/machine/batch_check.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>

#include "client/gateway/player/player.h"

namespace kcs::gateway {
namespace {

using Columns = google::protobuf::RepeatedPtrField<v1::Column>;

constexpr int kMostSetpoints = 1000;

static_assert(std::endian::native == std::endian::little, "the checksum is that of little-endian numbers");

uLong add(uLong sum, const Columns& columns) {
  for (const v1::Column& column : columns) {
    sum = crc32_z(sum, reinterpret_cast<const Bytef*>(column.values().data()),
                  static_cast<std::size_t>(column.values_size()) * sizeof(double));
  }
  return sum;
}

int rows(const Columns& columns) { return columns.empty() ? 0 : columns[0].values_size(); }

bool is_even(const Columns& columns) {
  return std::all_of(columns.begin(), columns.end(),
                     [&](const v1::Column& column) { return column.values_size() == rows(columns); });
}

bool is_finite(const Columns& columns) {
  return std::all_of(columns.begin(), columns.end(), [](const v1::Column& column) {
    return std::all_of(column.values().begin(), column.values().end(),
                       [](double value) { return std::isfinite(value); });
  });
}

std::optional<std::string> find_damage(const Columns& columns, std::size_t axes, std::string_view name) {
  if (static_cast<std::size_t>(columns.size()) != axes) {
    return fmt::format("{} has {} columns for {} axes", name, columns.size(), axes);
  }
  if (!is_even(columns)) return fmt::format("the columns of {} differ in length", name);
  if (!is_finite(columns)) return fmt::format("{} holds something that is no number", name);
  return std::nullopt;
}

std::optional<std::string> find_damage_in_clock(const v1::MotionBatch& batch) {
  const v1::PlanClock& end = batch.end();
  for (const double value : {end.plan_time_s(), end.rate(), end.rate_change_s(), batch.tail_end_s()}) {
    if (!std::isfinite(value)) return "its clock is no number";
  }
  return std::nullopt;
}

std::optional<std::string> find_damage_in_markers(const v1::MotionBatch& batch) {
  if (batch.markers_size() > KCS_PLAYER_MARKERS) {
    return fmt::format("{} markers; the player takes {}", batch.markers_size(), static_cast<int>(KCS_PLAYER_MARKERS));
  }
  const auto ticks = static_cast<std::uint64_t>(rows(batch.position_mm()) + rows(batch.tail_mm()));
  const std::uint64_t end = batch.first_tick() + ticks;
  for (const v1::MarkerAt& marker : batch.markers()) {
    if (marker.tick() >= end) return fmt::format("a marker for tick {}, which is beyond its end", marker.tick());
  }
  return std::nullopt;
}

}  // namespace

std::uint32_t checksum_of(const v1::MotionBatch& batch) {
  return static_cast<std::uint32_t>(add(add(crc32_z(0, nullptr, 0), batch.position_mm()), batch.tail_mm()));
}

std::optional<std::string> find_damage(const v1::MotionBatch& batch, std::size_t axes) {
  if (checksum_of(batch) != batch.checksum()) return "its checksum does not match";
  if (auto damage = find_damage(batch.position_mm(), axes, "position_mm")) return damage;
  if (!batch.tail_mm().empty()) {
    if (auto damage = find_damage(batch.tail_mm(), axes, "tail_mm")) return damage;
  }
  const int setpoints = rows(batch.position_mm());
  const int tail = rows(batch.tail_mm());
  if (setpoints < 1 || setpoints > kMostSetpoints) {
    return fmt::format("{} setpoints; it must be 1 to {}", setpoints, kMostSetpoints);
  }
  if (setpoints + tail > KCS_PLAYER_SETPOINTS) {
    return fmt::format("{} setpoints with its stop tail; the player takes {}", setpoints + tail,
                       static_cast<int>(KCS_PLAYER_SETPOINTS));
  }
  if (batch.end_of_plan() && tail > 0) return "it ends the plan, yet has a stop tail";
  if (auto damage = find_damage_in_clock(batch)) return damage;
  return find_damage_in_markers(batch);
}

}  // namespace kcs::gateway
