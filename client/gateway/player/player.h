/* The player: what goes to the drives at each tick, and what stops them.
 *
 * One small core for every driver: the simulated drives call it from a thread of the gateway, the LinuxCNC component
 * from the real-time thread of HAL. It is plain C (C11 and C++), so that both can. It neither allocates nor locks nor
 * makes a system call, and its time for a tick is bounded.
 *
 * The gateway, in whatever process, hands it batches of setpoints through `struct kcs_player_memory`, which holds no
 * pointers and may lie in shared memory. Every batch carries its stop tail: the way from its last setpoint to rest. The
 * player plays batch after batch. When there is no next one, or it is told to stop, it plays the tail of the batch that
 * it is in, to its end, and then stands: it never extrapolates and never stops at once. A gateway that dies leaves the
 * player with what it has.
 *
 * It does not trust what it is given. Before a batch is played, the batch and its tail must go on from the setpoints
 * before without breaking the machine's own limits of velocity, acceleration and jerk (measured by the first, second
 * and third differences of the positions), and the tail must end at rest; otherwise the batch is refused, and the tail
 * of the one before it is played. What is checked is a copy, which is what is played: whoever writes to the shared
 * memory later changes nothing.
 *
 * SPDX-License-Identifier: Apache-2.0 OR GPL-2.0-or-later
 */
#ifndef KCS_CLIENT_GATEWAY_PLAYER_PLAYER_H
#define KCS_CLIENT_GATEWAY_PLAYER_PLAYER_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
  KCS_PLAYER_AXES = 3,         /* X, Y, Z; a machine with two leaves Z at 0 */
  KCS_PLAYER_SLOTS = 8,        /* batches between gateway and player; small: what lies here cannot be replaced */
  KCS_PLAYER_SETPOINTS = 4096, /* of a batch and its tail together */
  KCS_PLAYER_MARKERS = 16,     /* in a batch */
  KCS_PLAYER_CHECKS = 64       /* setpoints that are checked ahead in one tick; what is due is checked at once */
};

#define KCS_PLAYER_MAGIC UINT64_C(0x6b6373706c617931) /* "kcsplay1": layout of this version */

enum kcs_player_state {
  KCS_PLAYER_OFF,      /* drives off; the command follows the actual position; a run is over */
  KCS_PLAYER_READY,    /* drives on, at rest, without a run: before the first, after the end of one */
  KCS_PLAYER_RUNNING,  /* a batch is played */
  KCS_PLAYER_STOPPING, /* a stop tail is played */
  KCS_PLAYER_HELD,     /* at rest on the path of a run that is not over */
  KCS_PLAYER_FAULT     /* latched until it is switched off; the command follows the actual position; a run is over */
};

/* Why the player left the stream of batches last, or refused to begin; none again when it begins, or is switched on. */
enum kcs_player_reason {
  KCS_PLAYER_NONE,
  KCS_PLAYER_END,             /* the end of the run is out */
  KCS_PLAYER_ASKED,           /* stop_requests or the hold input */
  KCS_PLAYER_STARVED,         /* no batch when one was due */
  KCS_PLAYER_OUT_OF_ORDER,    /* the next batch does not begin where this one ends */
  KCS_PLAYER_MALFORMED,       /* counts beyond the layout, no number, a tail after the end of the run */
  KCS_PLAYER_TOO_FAST,        /* the next batch or its tail breaks a limit: of velocity, */
  KCS_PLAYER_TOO_STRONG,      /* of acceleration, */
  KCS_PLAYER_TOO_JERKY,       /* of jerk */
  KCS_PLAYER_NOT_AT_REST,     /* its tail does not end at rest */
  KCS_PLAYER_DRIVE_FAULT,     /* input, or an actual position that is no number */
  KCS_PLAYER_FOLLOWING_ERROR, /* beyond the limit */
  KCS_PLAYER_SWITCHED_OFF     /* the enable input fell while moving */
};

/* The machine's own. */
struct kcs_player_profile {
  uint32_t axes; /* 2 or 3 */
  uint32_t unused;
  double period_s;
  double velocity_mm_s[KCS_PLAYER_AXES];
  double acceleration_mm_s2[KCS_PLAYER_AXES];
  double jerk_mm_s3[KCS_PLAYER_AXES];
  double following_error_mm[KCS_PLAYER_AXES]; /* more is a fault */
};

struct kcs_player_marker {
  uint32_t setpoint; /* of the batch and then of its tail, from 0: comes out with it */
  uint32_t kind;     /* MarkerKind in planning.proto */
  double value;
};

struct kcs_player_batch {
  uint64_t run;        /* number, from 1; another one begins a run, at rest only, with branch 0 and tick 0 */
  uint64_t branch;     /* the player's, or the batch is dropped as stale */
  uint64_t first_tick; /* of the run: the number of setpoints of it that were played before */
  uint32_t setpoints;  /* ≥ 1 */
  uint32_t tail;       /* setpoints of the stop tail, may be 0 where the batch ends at rest */
  uint32_t last;       /* 1: ends the run, at rest */
  uint32_t marker_count;
  double rest_s; /* plan time where the tail comes to rest: the player looks not at it, but tells it (see report) */
  struct kcs_player_marker markers[KCS_PLAYER_MARKERS];
  double position_mm[KCS_PLAYER_SETPOINTS][KCS_PLAYER_AXES]; /* of the batch, then of the tail */
};

/* What the player says, whole and consistent (kcs_player_read). */
struct kcs_player_report {
  uint64_t ticks; /* of the player, since it was started */
  uint32_t state; /* enum kcs_player_state */
  uint32_t reason;
  uint64_t run;
  uint64_t branch;  /* how often the run left the stream of batches, or was asked to stop while held */
  uint64_t played;  /* setpoints of the run, tails included */
  double rest_s;    /* of the batch whose tail it played last: so a gateway knows where it stands that came later */
  uint64_t batches; /* taken off the slots so far, played or not */
  uint64_t starvations, refused, stale;
  /* The stop_requests that has been answered: the player rests, or its tail is being played. What lay in the slots of a
   * player that did not run is dropped then; so put nothing between asking for a stop and reading here that it is
   * obeyed. */
  uint64_t stops_obeyed;
  double command_mm[KCS_PLAYER_AXES];
  double actual_mm[KCS_PLAYER_AXES];
  double largest_following_error_mm[KCS_PLAYER_AXES];
};

/* What gateway and player share. Zeroed memory with kcs_player_start() called is a player that is switched off. */
struct kcs_player_memory {
  uint64_t magic;
  struct kcs_player_profile profile;
  /* Written by the gateway. */
  uint64_t put;           /* batches so far; slot = number % KCS_PLAYER_SLOTS */
  uint64_t stop_requests; /* raised by one to ask for a stop */
  /* Written by the player. */
  uint64_t taken; /* batches whose slots are free again */
  uint64_t report_version;
  struct kcs_player_report report;
  struct kcs_player_batch slots[KCS_PLAYER_SLOTS];
};

/* A batch out of the shared memory, as far as it has been checked. */
struct kcs_player_copy {
  struct kcs_player_batch batch;
  double end_mm[3][KCS_PLAYER_AXES]; /* the last three setpoints before its tail, the latest first */
};

/* How the check of the next batch stands. */
enum kcs_player_check { KCS_PLAYER_UNSEEN, KCS_PLAYER_UNDER_WAY, KCS_PLAYER_PASSED, KCS_PLAYER_REFUSED };

/* The player's own, of its process: about 200 kB, most of it the batch that is played and the next one. */
struct kcs_player {
  struct kcs_player_memory *memory;
  struct kcs_player_profile profile; /* as it was at the start: nobody changes it from outside */
  struct kcs_player_report report;
  double largest_mm[3][KCS_PLAYER_AXES]; /* first, second and third difference that the limits allow */
  bool run_open;                         /* a run has begun and is not over */
  bool stop;                             /* asked for while running */
  uint32_t ticks_at_rest;                /* up to 3: the setpoints that lie behind a check from rest */
  struct kcs_player_copy copies[2];
  uint32_t current; /* the copy that is played; the other one is for the next batch */
  uint32_t next;    /* setpoint of the current one */
  enum kcs_player_check check;
  uint32_t checked;                     /* setpoints of the next batch, then ticks of rest after it */
  uint32_t refusal;                     /* enum kcs_player_reason, if refused */
  double before_mm[3][KCS_PLAYER_AXES]; /* the setpoints before the one that is checked next, the latest first */
};

struct kcs_player_input {
  double actual_mm[KCS_PLAYER_AXES];
  bool enable;      /* the operator's, and every drive is ready to be on */
  bool hold;        /* the operator's: while it is on, nothing begins and what moves stops on the path */
  bool drive_fault; /* of any drive */
};

struct kcs_player_output {
  double command_mm[KCS_PLAYER_AXES];
  bool drives_on;  /* never without `enable`; in FAULT too, for drives need power to brake */
  bool quick_stop; /* FAULT: the drives stop by themselves */
  uint32_t marker_count;
  struct kcs_player_marker markers[KCS_PLAYER_MARKERS]; /* of this tick */
};

/* Prepares zeroed memory, before the player or the gateway uses it. */
void kcs_player_prepare(struct kcs_player_memory *memory, const struct kcs_player_profile *profile);

/* Begins to play from `memory`, which must have been prepared and must outlive the player; false if it is of another
 * version or its profile is not sound: 2 or 3 axes, every number of them finite and above 0. What was put before is
 * dropped. */
bool kcs_player_start(struct kcs_player *player, struct kcs_player_memory *memory);

/* One period goes by. Bounded: ordinarily KCS_PLAYER_CHECKS setpoints are checked, and once a batch, if it is due
 * before that has got to its end, up to KCS_PLAYER_SETPOINTS (some 0.1 ms). */
void kcs_player_tick(struct kcs_player *player, const struct kcs_player_input *input, struct kcs_player_output *output);

/* For the gateway, one thread of one process. The slot for the next batch, or null if all are taken; kcs_player_put()
 * hands it over. */
struct kcs_player_batch *kcs_player_free_slot(struct kcs_player_memory *memory);
void kcs_player_put(struct kcs_player_memory *memory);
void kcs_player_ask_to_stop(struct kcs_player_memory *memory);
/* A consistent copy of the report; false if the player writes it all the time (try again later). */
bool kcs_player_read(const struct kcs_player_memory *memory, struct kcs_player_report *report);

#ifdef __cplusplus
}
#endif

#endif
