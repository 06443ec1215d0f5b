#include "tests/faults/faults.h"

#include <thread>

namespace kcs::faults {
namespace {

using std::chrono::milliseconds;

// From the call on, s: what is promised of a hold, and of an override (proto/kcs/v1/machine.proto).
constexpr double kStopsWithin = 0.05, kChangesWithin = 0.1;

void wait(milliseconds time) { std::this_thread::sleep_for(time); }

void hold(Scene& scene, Chance&) {
  scene.hold();
  scene.wait_for(v1::RUN_STATE_HELD);
}

// A run of its own each time: the next one goes on from where this one comes to rest.
void abort(Scene& scene, Chance&) {
  scene.abort();
  scene.wait_for(v1::RUN_STATE_ABORTED);
}

void override_feed(Scene& scene, Chance& chance, double percent) {
  scene.set_override(percent);
  wait(chance.time(10, 600));
  scene.set_override(100);
}

// Often to 0.
void lower_feed(Scene& scene, Chance& chance) {
  override_feed(scene, chance, chance.time(0, 4).count() == 0 ? 0 : chance.uniform(1, 95));
}

// As far as the limits have room, which may be nowhere near.
void raise_feed(Scene& scene, Chance& chance) { override_feed(scene, chance, chance.uniform(105, 200)); }

void pull_link(Scene& scene, Chance& chance) {
  scene.cable().cut(true);
  wait(chance.time(0, 600));
  scene.cable().cut(false);
}

void stall_link(Scene& scene, Chance& chance) {
  scene.cable().stall(true);
  wait(chance.stall());
  scene.cable().stall(false);
}

void slow_link(Scene& scene, Chance& chance) {
  scene.cable().delay(chance.time(1, 80));
  wait(chance.time(100, 800));
  scene.cable().delay(milliseconds(0));
}

// The gateway notices it by a ping, and attaches anew.
void lose_link(Scene& scene, Chance&) {
  scene.cable().abandon();
  scene.wait_for(v1::RUN_STATE_HELD);
}

void corrupt_byte(Scene& scene, Chance&) { scene.cable().corrupt(); }

void pause_server(Scene& scene, Chance& chance) {
  scene.service().pause(true);
  wait(chance.time(1, 700));
  scene.service().pause(false);
}

void kill_server(Scene& scene, Chance& chance) { scene.service().kill_and_restart(chance.time(0, 500)); }

void drain_server(Scene& scene, Chance& chance) { scene.service().drain_and_restart(chance.time(0, 500)); }

void exchange_another_server(Scene& scene, Chance&) { scene.service().exchange_another(); }

void kill_gateway(Scene& scene, Chance& chance) { scene.restart_gateway(chance.time(0, 500)); }

void repeat_batch(Scene& scene, Chance&) { scene.scrambler().play({.kind = Trick::kRepeat}); }

void reorder_batches(Scene& scene, Chance&) { scene.scrambler().play({.kind = Trick::kSwap}); }

void lose_batch(Scene& scene, Chance&) { scene.scrambler().play({.kind = Trick::kLose}); }

void delay_batch(Scene& scene, Chance& chance) {
  scene.scrambler().play({.kind = Trick::kDelay, .delay = chance.time(1, 500)});
}

// By more than a machine can move in a period: less would be a motion like any other.
void corrupt_batch(Scene& scene, Chance& chance) {
  const auto kind = chance.time(0, 1).count() == 0 ? Trick::kCorrupt : Trick::kForge;
  scene.scrambler().play({.kind = kind, .place = chance.uniform(0, 1), .change_mm = chance.uniform(1, 10)});
}

}  // namespace

std::vector<Fault> all_faults() {
  return {{.name = "hold", .happen = hold, .reaction_s = kStopsWithin},
          {.name = "abort", .happen = abort, .reaction_s = kStopsWithin},
          {.name = "feed lowered", .happen = lower_feed, .reaction_s = kChangesWithin, .stops_by_tail = false},
          {.name = "feed raised", .happen = raise_feed, .stops_by_tail = false},
          {.name = "link pulled", .happen = pull_link},
          {.name = "link stalled", .happen = stall_link},
          {.name = "link slow", .happen = slow_link},
          {.name = "link dead", .happen = lose_link},
          {.name = "byte corrupted", .happen = corrupt_byte},
          {.name = "server slow", .happen = pause_server},
          {.name = "server kill -9", .happen = kill_server},
          {.name = "server drained", .happen = drain_server},
          {.name = "replica kill -9", .happen = kill_server, .replicas = true},
          {.name = "replica drained", .happen = drain_server, .replicas = true},
          {.name = "replica added", .happen = exchange_another_server, .replicas = true},
          {.name = "batch repeated", .happen = repeat_batch, .scrambles = true},
          {.name = "batches reordered", .happen = reorder_batches, .scrambles = true},
          {.name = "batch lost", .happen = lose_batch, .scrambles = true},
          {.name = "batch delayed", .happen = delay_batch, .scrambles = true},
          {.name = "batch corrupted", .happen = corrupt_batch, .scrambles = true},
          {.name = "gateway kill -9", .happen = kill_gateway, .kills_gateway = true}};
}

}  // namespace kcs::faults
