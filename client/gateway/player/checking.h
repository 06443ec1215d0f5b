/* The check of the next batch, ahead of its time; see player.h.
 *
 * SPDX-License-Identifier: Apache-2.0 OR GPL-2.0-or-later
 */
#ifndef KCS_CLIENT_GATEWAY_PLAYER_CHECKING_H
#define KCS_CLIENT_GATEWAY_PLAYER_CHECKING_H

#include "client/gateway/player/player.h"

/* The differences that the profile's limits allow. */
void kcs_player_measure_limits(struct kcs_player *player);

/* Whether it stands with its drives on, so that something can begin. */
bool kcs_player_rests(const struct kcs_player *player);

/* Drops what is stale, takes up the next batch, and checks up to `setpoints` setpoints more of it.
 * A batch that is
 * refused while another one is played ends the looking ahead: that one's tail comes next. */
void kcs_player_look_ahead(struct kcs_player *player, uint32_t setpoints);

/* Makes void what has been looked at; what is in the slots stays there. */
void kcs_player_forget_next(struct kcs_player *player);

/* Makes void what is in the slots too. */
void kcs_player_drop_all(struct kcs_player *player);

#endif
