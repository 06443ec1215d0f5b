#include "tests/faults/figures.h"

#include <algorithm>

#include "server/runs/batch_maker.h"

namespace kcs::faults {
namespace {

using Places = std::vector<Place>;

constexpr std::size_t kBatch = 20;        // setpoints, as the gateway has them by default
constexpr std::size_t kUnseen = 3;        // setpoints of a tail that may still look like the plan
constexpr double kLongestReaction = 1.0;  // s: what comes later has other reasons

bool at_planned_pace(const Places& places, std::size_t i) {
  if (i < kBatch) return false;
  return std::all_of(places.begin() + static_cast<std::ptrdiff_t>(i - kBatch + 1),
                     places.begin() + static_cast<std::ptrdiff_t>(i + 1),
                     [](const Place& place) { return place.as_planned; });
}

bool at_end(const Place& place) { return place.time >= place.run->plan.trajectory.duration(); }

// From `instant`, with the first command from then on, to the first one that is not the planned pace.
std::optional<double> reaction(const Commands& commands, const Places& places, double instant, std::size_t i) {
  if (!at_planned_pace(places, i - 1)) return std::nullopt;
  while (i < places.size() && places[i].as_planned) ++i;
  if (i == places.size() || at_end(places[i - 1])) return std::nullopt;
  const double took = commands[i].time - instant;
  return took < kLongestReaction ? std::optional(took) : std::nullopt;
}

// How long the plan's tail is behind a place at the planned pace, in setpoints.
std::optional<std::size_t> planned_tail(const Place& place, const motion::AxisLimits& limits, double period) {
  const runs::BatchOptions options{.period = period, .setpoints = kBatch};
  runs::BatchMaker maker(place.run->plan, limits, options);
  const auto batch = maker.next({.plan_time = place.time - static_cast<double>(kBatch) * period, .rate = 1}, 1);
  return batch ? std::optional(batch->tail.size()) : std::nullopt;
}

// When the motion should rest at the latest that left the planned pace at places[last], as the index of a place. The
// first setpoints of a tail may not differ from the plan yet; and tails that begin a tick apart may be very different.
std::optional<std::size_t> planned_rest(const Places& places, std::size_t last, const motion::AxisLimits& limits,
                                        double period) {
  std::optional<std::size_t> rest;
  for (std::size_t i = last - kUnseen; i <= last; ++i) {
    if (const auto tail = planned_tail(places[i], limits, period)) rest = std::max(rest.value_or(0), i + *tail);
  }
  return rest;
}

}  // namespace

Figures measure(const Commands& commands, const Verdict& verdict, const std::vector<double>& instants,
                const motion::AxisLimits& limits, double period) {
  const Places& places = verdict.places;
  Figures figures;
  std::size_t next = 0;
  for (const double instant : instants) {
    while (next < commands.size() && commands[next].time < instant) ++next;
    if (next == 0 || next == commands.size() || !places[next - 1].moves) continue;
    ++figures.instants;
    if (const auto took = reaction(commands, places, instant, next)) figures.reactions.push_back(*took);
  }
  std::size_t last_planned = 0;  // before the motion left the planned pace; 0: it was not at it
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (at_planned_pace(places, i)) last_planned = i;
    if (!places[i - 1].moves || places[i].moves) continue;
    ++figures.stops;
    if (last_planned > 0 && !at_end(places[i])) {
      figures.stop_times.push_back(static_cast<double>(i - 1 - last_planned) * period);
      if (const auto rest = planned_rest(places, last_planned, limits, period)) {
        const double beyond = (static_cast<double>(i - 1) - static_cast<double>(*rest)) * period;
        figures.longest_beyond_tail = std::max(figures.longest_beyond_tail, beyond);
      }
    }
    last_planned = 0;
  }
  std::sort(figures.reactions.begin(), figures.reactions.end());
  std::sort(figures.stop_times.begin(), figures.stop_times.end());
  return figures;
}

std::optional<double> median(const std::vector<double>& sorted) {
  return sorted.empty() ? std::nullopt : std::optional(sorted[sorted.size() / 2]);
}

}  // namespace kcs::faults
