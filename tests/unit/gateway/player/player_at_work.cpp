#include "tests/unit/gateway/player/player_at_work.h"

#include <algorithm>
#include <stdexcept>

namespace kcs::test {

PlayerAtWork::PlayerAtWork() {
  kcs_player_prepare(memory.get(), &profile);
  if (!kcs_player_start(player.get(), memory.get())) throw std::logic_error("the player does not start");
  std::copy(line.origin.begin(), line.origin.end(), input.actual_mm);
}

void PlayerAtWork::tick(int ticks) {
  for (int i = 0; i < ticks; ++i) {
    kcs_player_tick(player.get(), &input, &output);
    std::copy(std::begin(output.command_mm), std::end(output.command_mm), input.actual_mm);
    watch.see(output.command_mm);
    markers.insert(markers.end(), output.markers, output.markers + output.marker_count);
  }
}

bool PlayerAtWork::tick_until(kcs_player_state wanted) {
  for (int i = 0; i < 60'000 && state() != wanted; ++i) tick();
  return state() == wanted;
}

void PlayerAtWork::switch_on() {
  input.enable = true;
  if (!tick_until(KCS_PLAYER_READY)) throw std::logic_error("the player does not switch on");
}

bool PlayerAtWork::feed(std::uint64_t ticks) {
  for (std::uint64_t i = 0; i < ticks; ++i) {
    while (memory->put - memory->taken < 2 && put_next()) continue;
    tick();
  }
  return true;
}

bool PlayerAtWork::feed_until(kcs_player_state wanted) {
  for (int i = 0; i < 60'000 && state() != wanted; ++i) feed(1);
  return state() == wanted;
}

std::unique_ptr<kcs_player_batch> PlayerAtWork::next() {
  auto batch = std::make_unique<kcs_player_batch>();
  run.write(*batch);
  return batch;
}

bool PlayerAtWork::put(const kcs_player_batch& batch) {
  kcs_player_batch* slot = kcs_player_free_slot(memory.get());
  if (!slot) return false;
  *slot = batch;
  kcs_player_put(memory.get());
  return true;
}

std::unique_ptr<kcs_player_batch> PlayerAtWork::standing(std::uint32_t setpoints, std::uint32_t tail) const {
  auto batch = std::make_unique<kcs_player_batch>();
  batch->run = std::max<std::uint64_t>(1, report().run);
  batch->branch = report().branch;
  batch->first_tick = report().played;
  batch->setpoints = setpoints;
  batch->tail = tail;
  for (std::uint32_t i = 0; i < setpoints + tail; ++i) {
    std::copy(std::begin(output.command_mm), std::end(output.command_mm), batch->position_mm[i]);
  }
  return batch;
}

bool PlayerAtWork::put_next() {
  kcs_player_batch* slot = run.over() ? nullptr : kcs_player_free_slot(memory.get());
  if (!slot) return false;
  run.write(*slot);
  kcs_player_put(memory.get());
  return true;
}

void PlayerAtWork::resume() { run.begin(report().run, report().branch, report().played, place()); }

void PlayerAtWork::begin_run(std::uint64_t number) { run.begin(number, 0, 0, place()); }

}  // namespace kcs::test
