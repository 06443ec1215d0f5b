// The memory through which the gateway reaches the component.
//
// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef KCS_CLIENT_GATEWAY_HAL_SHARED_MEMORY_H
#define KCS_CLIENT_GATEWAY_HAL_SHARED_MEMORY_H

#include "client/gateway/player/player.h"

struct kcs_shared_memory {
  struct kcs_player_memory *memory;
  char name[64];
  int file;  // locked for as long as it is open: the memory has an owner
};

// Makes the POSIX shared memory /kcs-NAME, zeroed, in place of what an owner has left behind who lives no more.
// `group`: name of the group that may write to it, empty for that of this process. NAME: as a machine's, 1 to 31
// letters, digits,
// "-" and "_". Null if it is there, else the reason why it is not.
const char *kcs_open_shared_memory(struct kcs_shared_memory *shared, const char *name, const char *group);

// Removes it. Gateways that have it mapped see no more ticks.
void kcs_close_shared_memory(struct kcs_shared_memory *shared);

#endif
