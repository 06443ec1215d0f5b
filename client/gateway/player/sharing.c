/* SPDX-License-Identifier: Apache-2.0 OR GPL-2.0-or-later */
#include "client/gateway/player/sharing.h"

#include <stddef.h>

/* The report goes over in words, each of them atomic, between two raises of its version: odd while it is written. Every
 * word is released and acquired by itself, instead of fences around plain copies, which ThreadSanitizer does not know.
 */
typedef uint64_t __attribute__((may_alias)) report_word;

enum { kcs_report_words = sizeof(struct kcs_player_report) / sizeof(report_word), kcs_report_attempts = 1000 };

_Static_assert(sizeof(struct kcs_player_report) % sizeof(report_word) == 0, "the report is made of whole words");

void kcs_player_publish(struct kcs_player *player) {
  struct kcs_player_memory *memory = player->memory;
  const report_word *from = (const report_word *)&player->report;
  report_word *to = (report_word *)&memory->report;
  const uint64_t version = player->report.ticks * 2;
  __atomic_store_n(&memory->report_version, version + 1, __ATOMIC_RELAXED);
  for (int i = 0; i < kcs_report_words; ++i) __atomic_store_n(to + i, from[i], __ATOMIC_RELEASE);
  __atomic_store_n(&memory->report_version, version + 2, __ATOMIC_RELEASE);
}

bool kcs_player_read(const struct kcs_player_memory *memory, struct kcs_player_report *report) {
  const report_word *from = (const report_word *)&memory->report;
  report_word *to = (report_word *)report;
  for (int attempt = 0; attempt < kcs_report_attempts; ++attempt) {
    const uint64_t version = __atomic_load_n(&memory->report_version, __ATOMIC_ACQUIRE);
    if (version % 2 != 0) continue;
    for (int i = 0; i < kcs_report_words; ++i) to[i] = __atomic_load_n(from + i, __ATOMIC_ACQUIRE);
    if (__atomic_load_n(&memory->report_version, __ATOMIC_RELAXED) == version) return true;
  }
  return false;
}

uint64_t kcs_player_waiting(const struct kcs_player *player) {
  const uint64_t waiting = __atomic_load_n(&player->memory->put, __ATOMIC_ACQUIRE) - player->report.batches;
  return waiting <= KCS_PLAYER_SLOTS ? waiting : 0;
}

const volatile struct kcs_player_batch *kcs_player_first(const struct kcs_player *player) {
  return &player->memory->slots[player->report.batches % KCS_PLAYER_SLOTS];
}

void kcs_player_take(struct kcs_player *player, uint64_t count) {
  player->report.batches += count;
  __atomic_store_n(&player->memory->taken, player->report.batches, __ATOMIC_RELEASE);
}

uint64_t kcs_player_stop_requests(const struct kcs_player *player) {
  return __atomic_load_n(&player->memory->stop_requests, __ATOMIC_ACQUIRE);
}

struct kcs_player_batch *kcs_player_free_slot(struct kcs_player_memory *memory) {
  const uint64_t put = __atomic_load_n(&memory->put, __ATOMIC_RELAXED);
  if (put - __atomic_load_n(&memory->taken, __ATOMIC_ACQUIRE) >= KCS_PLAYER_SLOTS) return NULL;
  return &memory->slots[put % KCS_PLAYER_SLOTS];
}

void kcs_player_put(struct kcs_player_memory *memory) { __atomic_fetch_add(&memory->put, 1, __ATOMIC_RELEASE); }

void kcs_player_ask_to_stop(struct kcs_player_memory *memory) {
  __atomic_fetch_add(&memory->stop_requests, 1, __ATOMIC_RELEASE);
}
