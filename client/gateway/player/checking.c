/* SPDX-License-Identifier: Apache-2.0 OR GPL-2.0-or-later */
#include "client/gateway/player/checking.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "client/gateway/player/sharing.h"

/* A batch has ended at rest if this many repeats of its last setpoint go on from it: all differences are 0 then. */
enum { kcs_rest = 3 };

/* What rounding adds to a limit, and to the third difference of positions: four roundings and more of a position. */
static const double kcs_margin = 1 + 1e-6;
static const double kcs_rounding = 8.0 / 4503599627370496.0; /* 8 · 2^-52 */

void kcs_player_measure_limits(struct kcs_player *player) {
  const struct kcs_player_profile *profile = &player->profile;
  const double h = profile->period_s;
  for (uint32_t axis = 0; axis < profile->axes; ++axis) {
    player->largest_mm[0][axis] = profile->velocity_mm_s[axis] * h * kcs_margin;
    player->largest_mm[1][axis] = profile->acceleration_mm_s2[axis] * h * h * kcs_margin;
    player->largest_mm[2][axis] = profile->jerk_mm_s3[axis] * h * h * h * kcs_margin;
  }
}

bool kcs_player_rests(const struct kcs_player *player) {
  return player->report.state == KCS_PLAYER_READY || player->report.state == KCS_PLAYER_HELD;
}

static const struct kcs_player_copy *current(const struct kcs_player *player) {
  return &player->copies[player->current];
}

static struct kcs_player_copy *upcoming(struct kcs_player *player) { return &player->copies[1 - player->current]; }

static bool stale(const struct kcs_player *player, const struct kcs_player_batch *batch) {
  const struct kcs_player_report *report = &player->report;
  if (batch->run != report->run) return !kcs_player_rests(player) || batch->branch != 0;
  return !player->run_open || batch->branch != report->branch;
}

static void drop(struct kcs_player *player, uint64_t count) {
  player->report.stale += count;
  kcs_player_take(player, count);
}

void kcs_player_forget_next(struct kcs_player *player) {
  if (player->check == KCS_PLAYER_PASSED) ++player->report.stale;
  player->check = KCS_PLAYER_UNSEEN;
}

void kcs_player_drop_all(struct kcs_player *player) {
  kcs_player_forget_next(player);
  drop(player, kcs_player_waiting(player));
}

static void refuse(struct kcs_player *player, uint32_t reason) {
  ++player->report.refused;
  kcs_player_take(player, 1);
  if (kcs_player_rests(player)) {
    player->report.reason = reason;
    player->check = KCS_PLAYER_UNSEEN;
  } else {
    player->refusal = reason;
    player->check = KCS_PLAYER_REFUSED;
  }
}

static bool well_formed(const struct kcs_player_batch *batch) {
  if (batch->setpoints < 1 || batch->setpoints > KCS_PLAYER_SETPOINTS) return false;
  if (batch->tail > KCS_PLAYER_SETPOINTS - batch->setpoints) return false;
  if (batch->last > 1 || (batch->last == 1 && batch->tail > 0)) return false;
  if (batch->marker_count > KCS_PLAYER_MARKERS) return false;
  for (uint32_t i = 0; i < batch->marker_count; ++i) {
    if (batch->markers[i].setpoint >= batch->setpoints + batch->tail) return false;
    if (!isfinite(batch->markers[i].value)) return false;
  }
  return true;
}

/* Where the next batch has to begin. */
static uint64_t tick_due(const struct kcs_player *player, uint64_t run) {
  if (run != player->report.run) return 0;
  if (kcs_player_rests(player)) return player->report.played;
  return current(player)->batch.first_tick + current(player)->batch.setpoints;
}

/* Takes over all but the positions. */
static void copy_head(struct kcs_player_batch *batch, const volatile struct kcs_player_batch *slot) {
  batch->run = slot->run;
  batch->branch = slot->branch;
  batch->first_tick = slot->first_tick;
  batch->setpoints = slot->setpoints;
  batch->tail = slot->tail;
  batch->last = slot->last;
  batch->marker_count = slot->marker_count;
  batch->rest_s = slot->rest_s;
  for (int i = 0; i < KCS_PLAYER_MARKERS; ++i) {
    batch->markers[i].setpoint = slot->markers[i].setpoint;
    batch->markers[i].kind = slot->markers[i].kind;
    batch->markers[i].value = slot->markers[i].value;
  }
}

static void begin(struct kcs_player *player, const struct kcs_player_batch *batch) {
  if (!well_formed(batch)) {
    refuse(player, KCS_PLAYER_MALFORMED);
    return;
  }
  if (batch->first_tick != tick_due(player, batch->run)) {
    refuse(player, KCS_PLAYER_OUT_OF_ORDER);
    return;
  }
  for (int i = 0; i < 3; ++i) {
    const double *before = kcs_player_rests(player) ? player->report.command_mm : current(player)->end_mm[i];
    memcpy(player->before_mm[i], before, sizeof player->before_mm[i]);
  }
  player->checked = 0;
  player->check = KCS_PLAYER_UNDER_WAY;
}

/* Whether `position` may come after the setpoints before. */
static uint32_t step(const struct kcs_player *player, const double *position) {
  for (uint32_t axis = 0; axis < player->profile.axes; ++axis) {
    const double p = position[axis];
    if (!isfinite(p)) return KCS_PLAYER_MALFORMED;
    const double step_1 = p - player->before_mm[0][axis];
    const double step_2 = player->before_mm[0][axis] - player->before_mm[1][axis];
    const double step_3 = player->before_mm[1][axis] - player->before_mm[2][axis];
    const double rounding = kcs_rounding * fabs(p);
    if (!(fabs(step_1) <= player->largest_mm[0][axis] + rounding)) return KCS_PLAYER_TOO_FAST;
    if (!(fabs(step_1 - step_2) <= player->largest_mm[1][axis] + rounding)) return KCS_PLAYER_TOO_STRONG;
    if (!(fabs((step_1 - step_2) - (step_2 - step_3)) <= player->largest_mm[2][axis] + rounding)) {
      return KCS_PLAYER_TOO_JERKY;
    }
  }
  return KCS_PLAYER_NONE;
}

/* Copies and checks one setpoint more, or one tick of rest after the last of them. */
static void check_one(struct kcs_player *player) {
  const volatile struct kcs_player_batch *slot = kcs_player_first(player);
  struct kcs_player_copy *copy = upcoming(player);
  const uint32_t total = copy->batch.setpoints + copy->batch.tail;
  const bool rest = player->checked >= total;
  double *position = copy->batch.position_mm[rest ? total - 1 : player->checked];
  if (player->checked == copy->batch.setpoints) memcpy(copy->end_mm, player->before_mm, sizeof copy->end_mm);
  if (!rest) {
    for (uint32_t axis = 0; axis < player->profile.axes; ++axis) {
      position[axis] = slot->position_mm[player->checked][axis];
    }
  }
  const uint32_t fault = step(player, position);
  if (fault != KCS_PLAYER_NONE) {
    refuse(player, rest ? KCS_PLAYER_NOT_AT_REST : fault);
    return;
  }
  memmove(player->before_mm[1], player->before_mm[0], 2 * sizeof player->before_mm[0]);
  memcpy(player->before_mm[0], position, sizeof player->before_mm[0]);
  if (++player->checked == total + kcs_rest) {
    player->check = KCS_PLAYER_PASSED;
    kcs_player_take(player, 1);
  }
}

/* The head of the first batch in the slots that is not stale; those before it are dropped. Null: there is none. */
static const struct kcs_player_batch *find_next(struct kcs_player *player) {
  struct kcs_player_batch *batch = &upcoming(player)->batch;
  for (uint64_t waiting = kcs_player_waiting(player); waiting > 0; --waiting) {
    copy_head(batch, kcs_player_first(player));
    if (!stale(player, batch)) return batch;
    drop(player, 1);
  }
  return NULL;
}

void kcs_player_look_ahead(struct kcs_player *player, uint32_t setpoints) {
  if (player->check == KCS_PLAYER_UNSEEN) {
    const struct kcs_player_batch *batch = find_next(player);
    /* While a tail is played, the batches of the branch after it wait for its end. */
    if (!batch || player->report.state == KCS_PLAYER_STOPPING) return;
    begin(player, batch);
  }
  for (uint32_t i = 0; i < setpoints && player->check == KCS_PLAYER_UNDER_WAY; ++i) check_one(player);
}
