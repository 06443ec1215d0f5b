/* The words through which player and gateway meet; see player.h.
 *
 * SPDX-License-Identifier: Apache-2.0 OR GPL-2.0-or-later
 */
#ifndef KCS_CLIENT_GATEWAY_PLAYER_SHARING_H
#define KCS_CLIENT_GATEWAY_PLAYER_SHARING_H

#include "client/gateway/player/player.h"

/* The player's report, for kcs_player_read(). */
void kcs_player_publish(struct kcs_player *player);

/* Batches that wait in the slots. None if the gateway claims more than there are slots: it is not to be trusted. */
uint64_t kcs_player_waiting(const struct kcs_player *player);

/* The slot of the first of them. The gateway may be writing to it, against the rules: read what matters once. */
const volatile struct kcs_player_batch *kcs_player_first(const struct kcs_player *player);

/* Frees the slots of the first `count` of them. */
void kcs_player_take(struct kcs_player *player, uint64_t count);

uint64_t kcs_player_stop_requests(const struct kcs_player *player);

#endif
