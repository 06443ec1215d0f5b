/* SPDX-License-Identifier: Apache-2.0 OR GPL-2.0-or-later */
#include "client/gateway/player/player.h"

#include <math.h>
#include <string.h>

#include "client/gateway/player/checking.h"
#include "client/gateway/player/sharing.h"

/* A check from rest takes the three setpoints before for the same: so many ticks go by before something begins. */
enum { kcs_ticks_of_rest = 3 };

static bool sound(const struct kcs_player_profile *profile) {
  if (profile->axes < 2 || profile->axes > KCS_PLAYER_AXES) return false;
  bool all = isfinite(profile->period_s) && profile->period_s > 0;
  for (uint32_t axis = 0; axis < profile->axes; ++axis) {
    const double limits[] = {profile->velocity_mm_s[axis], profile->acceleration_mm_s2[axis], profile->jerk_mm_s3[axis],
                             profile->following_error_mm[axis]};
    for (int i = 0; i < 4; ++i) all = all && isfinite(limits[i]) && limits[i] > 0;
  }
  return all;
}

void kcs_player_prepare(struct kcs_player_memory *memory, const struct kcs_player_profile *profile) {
  memory->profile = *profile;
  __atomic_store_n(&memory->magic, KCS_PLAYER_MAGIC, __ATOMIC_RELEASE);
}

bool kcs_player_start(struct kcs_player *player, struct kcs_player_memory *memory) {
  if (__atomic_load_n(&memory->magic, __ATOMIC_ACQUIRE) != KCS_PLAYER_MAGIC) return false;
  memset(player, 0, sizeof *player);
  player->memory = memory;
  player->profile = memory->profile;
  if (!sound(&player->profile)) return false;
  kcs_player_measure_limits(player);
  player->report.state = KCS_PLAYER_OFF;
  kcs_player_take(player, __atomic_load_n(&memory->put, __ATOMIC_ACQUIRE));
  kcs_player_publish(player);
  return true;
}

static bool moving(const struct kcs_player *player) {
  return player->report.state == KCS_PLAYER_RUNNING || player->report.state == KCS_PLAYER_STOPPING;
}

static bool follows_actual(const struct kcs_player *player) {
  return player->report.state == KCS_PLAYER_OFF || player->report.state == KCS_PLAYER_FAULT;
}

static void rest(struct kcs_player *player, uint32_t state) {
  player->report.state = state;
  player->run_open = state == KCS_PLAYER_HELD;
  player->ticks_at_rest = 0;
  player->stop = false;
  kcs_player_forget_next(player);
}

static void fail(struct kcs_player *player, uint32_t reason) {
  if (player->report.state == KCS_PLAYER_RUNNING) ++player->report.branch;
  player->report.reason = reason;
  rest(player, KCS_PLAYER_FAULT);
}

/* False if an actual position is no number: nothing may be made of it then. */
static bool read_actual(struct kcs_player *player, const struct kcs_player_input *input) {
  for (uint32_t axis = 0; axis < player->profile.axes; ++axis) {
    if (!isfinite(input->actual_mm[axis])) return false;
  }
  for (uint32_t axis = 0; axis < player->profile.axes; ++axis) player->report.actual_mm[axis] = input->actual_mm[axis];
  return true;
}

/* Whether the drives are where the last tick commanded them to. */
static bool followed(struct kcs_player *player) {
  struct kcs_player_report *report = &player->report;
  bool all = true;
  for (uint32_t axis = 0; axis < player->profile.axes; ++axis) {
    const double error = fabs(report->command_mm[axis] - report->actual_mm[axis]);
    if (error > report->largest_following_error_mm[axis]) report->largest_following_error_mm[axis] = error;
    all = all && error <= player->profile.following_error_mm[axis];
  }
  return all;
}

/* What the drives and the operator want, before anything is played. */
static void heed_machine(struct kcs_player *player, const struct kcs_player_input *input) {
  struct kcs_player_report *report = &player->report;
  const bool drives_sound = read_actual(player, input) && !input->drive_fault;
  if (follows_actual(player)) memcpy(report->command_mm, report->actual_mm, sizeof report->command_mm);
  if (report->state == KCS_PLAYER_FAULT) {
    if (!input->enable) rest(player, KCS_PLAYER_OFF);
  } else if (!input->enable) {
    if (moving(player)) {
      fail(player, KCS_PLAYER_SWITCHED_OFF);
    } else {
      rest(player, KCS_PLAYER_OFF);
    }
  } else if (!drives_sound) {
    fail(player, KCS_PLAYER_DRIVE_FAULT);
  } else if (report->state == KCS_PLAYER_OFF) {
    report->reason = KCS_PLAYER_NONE;
    rest(player, KCS_PLAYER_READY);
  } else if (!followed(player)) {
    fail(player, KCS_PLAYER_FOLLOWING_ERROR);
  }
}

/* Stops that are asked for. One that comes to a player at rest makes void what was on its way to it. */
static void heed_stops(struct kcs_player *player, bool hold) {
  struct kcs_player_report *report = &player->report;
  const uint64_t requests = kcs_player_stop_requests(player);
  const bool asked = requests != report->stops_obeyed;
  if (report->state == KCS_PLAYER_RUNNING) {
    player->stop = player->stop || asked || hold;
  } else if (asked) {
    if (report->state == KCS_PLAYER_HELD) ++report->branch;
    kcs_player_drop_all(player);
    report->stops_obeyed = requests;
  }
}

static void begin_to_play(struct kcs_player *player) {
  player->current = 1 - player->current;
  player->next = 0;
  player->check = KCS_PLAYER_UNSEEN;
  player->report.state = KCS_PLAYER_RUNNING;
}

/* Leaves HELD or READY for the next batch. */
static void begin_run(struct kcs_player *player) {
  const uint64_t run = player->copies[1 - player->current].batch.run;
  if (run != player->report.run) {
    player->report.run = run;
    player->report.branch = 0;
    player->report.played = 0;
    player->report.rest_s = 0;
  }
  player->run_open = true;
  player->report.reason = KCS_PLAYER_NONE;
  begin_to_play(player);
}

static void begin_tail(struct kcs_player *player) {
  struct kcs_player_report *report = &player->report;
  if (player->stop) {
    report->reason = KCS_PLAYER_ASKED;
    report->stops_obeyed = kcs_player_stop_requests(player);
  } else if (player->check == KCS_PLAYER_REFUSED) {
    report->reason = player->refusal;
  } else {
    report->reason = KCS_PLAYER_STARVED;
    ++report->starvations;
  }
  ++report->branch;
  report->rest_s = player->copies[player->current].batch.rest_s;
  report->state = KCS_PLAYER_STOPPING;
  kcs_player_forget_next(player);
}

/* After the last setpoint of a batch. */
static void leave_batch(struct kcs_player *player) {
  if (player->copies[player->current].batch.last == 1) {
    player->report.reason = KCS_PLAYER_END;
    player->report.rest_s = player->copies[player->current].batch.rest_s;
    rest(player, KCS_PLAYER_READY);
    return;
  }
  if (!player->stop) kcs_player_look_ahead(player, UINT32_MAX); /* to its end: it is due */
  if (!player->stop && player->check == KCS_PLAYER_PASSED) {
    begin_to_play(player);
  } else {
    begin_tail(player);
  }
}

static void play(struct kcs_player *player, struct kcs_player_output *output) {
  const struct kcs_player_batch *batch = &player->copies[player->current].batch;
  memcpy(player->report.command_mm, batch->position_mm[player->next], sizeof player->report.command_mm);
  for (uint32_t i = 0; i < batch->marker_count; ++i) {
    if (batch->markers[i].setpoint == player->next) output->markers[output->marker_count++] = batch->markers[i];
  }
  ++player->next;
  ++player->report.played;
}

static void move(struct kcs_player *player, bool hold, struct kcs_player_output *output) {
  const struct kcs_player_batch *batch = &player->copies[player->current].batch;
  if (kcs_player_rests(player)) {
    const bool rested = player->ticks_at_rest >= kcs_ticks_of_rest;
    if (rested && !hold && player->check == KCS_PLAYER_PASSED) begin_run(player);
  } else if (player->report.state == KCS_PLAYER_RUNNING && player->next == batch->setpoints) {
    leave_batch(player);
  }
  if (player->report.state == KCS_PLAYER_STOPPING && player->next == batch->setpoints + batch->tail) {
    rest(player, KCS_PLAYER_HELD);
  }
  if (moving(player)) {
    play(player, output);
  } else if (player->ticks_at_rest < kcs_ticks_of_rest) {
    ++player->ticks_at_rest;
  }
}

void kcs_player_tick(struct kcs_player *player, const struct kcs_player_input *input,
                     struct kcs_player_output *output) {
  ++player->report.ticks;
  output->marker_count = 0;
  heed_machine(player, input);
  heed_stops(player, input->hold);
  move(player, input->hold, output);
  kcs_player_look_ahead(player, KCS_PLAYER_CHECKS);
  memcpy(output->command_mm, player->report.command_mm, sizeof output->command_mm);
  output->drives_on = input->enable && player->report.state != KCS_PLAYER_OFF;
  output->quick_stop = player->report.state == KCS_PLAYER_FAULT;
  kcs_player_publish(player);
}
