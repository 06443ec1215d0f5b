// kcs_player: the player of kcs-gateway as a real-time component of LinuxCNC's HAL.
//
//   loadrt kcs_player name=router axes=3 group=kcs
//   addf kcs-player.tick servo-thread        after what reads the position, before what writes it
//
// The gateway hands batches of setpoints over through the shared memory /kcs-NAME; see client/gateway/player/player.h
// for what is done with them. A gateway that is killed leaves the machine on its path: the stop tail is played to its
// end.
//
// Shared memory. The component makes /kcs-NAME anew when it is loaded, and removes it when it is unloaded: its owner is
// the user who runs LinuxCNC, its mode 0660. Name in `group` a group to which the gateway's user belongs, if that is
// another user; whoever runs LinuxCNC must belong to it too. A gateway whose memory no longer ticks opens it again.
//
// Parameters (setp), all of them needed before the thread starts, for each axis x, y, z:
//   kcs-player.x.max-velocity         mm/s
//   kcs-player.x.max-acceleration     mm/s²
//   kcs-player.x.max-jerk             mm/s³
//   kcs-player.x.max-following-error  mm; beyond it the machine stops with a fault
// They are the machine's, not the plan's: what would break them is not played. They hold from the first tick on.
//
// Pins:
//   kcs-player.x.position-cmd  out float  mm; the actual position while the drives are off
//   kcs-player.x.position-fb   in  float  mm
//   kcs-player.enable          in  bit    switch on; must fall to leave a fault
//   kcs-player.hold            in  bit    stop on the path, begin nothing
//   kcs-player.drive-fault     in  bit    of any drive
//   kcs-player.drives-on       out bit    to the drives' enable
//   kcs-player.quick-stop      out bit    the drives are to stop by themselves
//   kcs-player.state           out s32    enum kcs_player_state: 0 off, 1 ready, 2 running, 3 stopping, 4 held, 5 fault
//   kcs-player.reason          out s32    enum kcs_player_reason: why it stopped or does not begin
//   kcs-player.running, .held, .moving    out bit  state 2; 4; 2 or 3
//   kcs-player.bad-limits      out bit    a parameter above is missing or not above 0: nothing will be played
//   kcs-player.spindle-on      out bit    as the program's markers have it, like the next six; off while the drives
//   kcs-player.spindle-forward out bit    are off and in a fault
//   kcs-player.spindle-speed   out float  1/min
//   kcs-player.surface-speed   out float  m/min; above 0 the spindle's speed is to follow from it and the tool's radius
//   kcs-player.speed-limit     out float  1/min; what it follows to at most, 0: no limit
//   kcs-player.mist            out bit
//   kcs-player.flood           out bit
//   kcs-player.ticks, .starvations, .refused  out u32  counted since it was loaded
//
// SPDX-License-Identifier: GPL-2.0-or-later
#include <errno.h>
#include <hal.h>
#include <rtapi.h>
#include <rtapi_app.h>

#include "client/gateway/hal/shared_memory.h"
#include "client/gateway/player/player.h"

MODULE_AUTHOR("kcs");
MODULE_DESCRIPTION("Plays the setpoints of kcs-gateway, and stops on the path when they end");
MODULE_LICENSE("GPL");

static char *name = "machine";
RTAPI_MP_STRING(name, "the shared memory is /kcs-NAME");
static char *group = "";
RTAPI_MP_STRING(group, "group that may open the shared memory; empty: that of the user who runs LinuxCNC");
static int axes = 3;
RTAPI_MP_INT(axes, "2 or 3");

// MarkerKind in proto/kcs/v1/planning.proto.
enum {
  SPINDLE_CLOCKWISE = 1,
  SPINDLE_COUNTERCLOCKWISE,
  SPINDLE_OFF,
  MIST_ON,
  FLOOD_ON,
  COOLANT_OFF,
  SPINDLE_SPEED_LIMIT = 9,
  SPINDLE_SURFACE_SPEED
};

struct axis_pins {
  hal_float_t *command, *feedback;
  hal_float_t velocity, acceleration, jerk, following_error;
};

// In HAL's memory, as HAL wants it.
struct pins {
  struct axis_pins axis[KCS_PLAYER_AXES];
  hal_bit_t *enable, *hold, *drive_fault;
  hal_bit_t *drives_on, *quick_stop, *running, *held, *moving, *bad_limits;
  hal_bit_t *spindle_on, *spindle_forward, *mist, *flood;
  hal_float_t *spindle_speed, *surface_speed, *speed_limit;
  hal_s32_t *state, *reason;
  hal_u32_t *ticks, *starvations, *refused;
};

// A component's state lives as long as its module is loaded, and it is loaded once.
static int component;
static struct pins *pins;
static struct kcs_shared_memory shared;
static struct kcs_player player;
static bool started;

static bool start(long period_ns) {
  struct kcs_player_profile profile = {.axes = (uint32_t)axes, .period_s = 1e-9 * (double)period_ns};
  for (int i = 0; i < axes; ++i) {
    profile.velocity_mm_s[i] = pins->axis[i].velocity;
    profile.acceleration_mm_s2[i] = pins->axis[i].acceleration;
    profile.jerk_mm_s3[i] = pins->axis[i].jerk;
    profile.following_error_mm[i] = pins->axis[i].following_error;
  }
  kcs_player_prepare(shared.memory, &profile);
  return kcs_player_start(&player, shared.memory);
}

static void switch_spindle(bool on, bool forward, double speed) {
  *pins->spindle_on = on;
  *pins->spindle_forward = on && forward;
  *pins->spindle_speed = on ? speed : 0;
  *pins->surface_speed = 0;
}

static void heed(const struct kcs_player_marker *marker) {
  switch (marker->kind) {
    case SPINDLE_CLOCKWISE:
      switch_spindle(true, true, marker->value);
      break;
    case SPINDLE_COUNTERCLOCKWISE:
      switch_spindle(true, false, marker->value);
      break;
    case SPINDLE_OFF:
      switch_spindle(false, false, 0);
      break;
    case MIST_ON:
      *pins->mist = true;
      break;
    case FLOOD_ON:
      *pins->flood = true;
      break;
    case COOLANT_OFF:
      *pins->mist = *pins->flood = false;
      break;
    case SPINDLE_SPEED_LIMIT:
      *pins->speed_limit = marker->value;
      break;
    case SPINDLE_SURFACE_SPEED:
      *pins->surface_speed = marker->value;
      break;
    default:  // dwells: the setpoints stand still by themselves
      break;
  }
}

static void tell(const struct kcs_player_output *output) {
  const struct kcs_player_report *report = &player.report;
  for (int i = 0; i < axes; ++i) *pins->axis[i].command = output->command_mm[i];
  *pins->drives_on = output->drives_on;
  *pins->quick_stop = output->quick_stop;
  *pins->state = (hal_s32_t)report->state;
  *pins->reason = (hal_s32_t)report->reason;
  *pins->running = report->state == KCS_PLAYER_RUNNING;
  *pins->held = report->state == KCS_PLAYER_HELD;
  *pins->moving = report->state == KCS_PLAYER_RUNNING || report->state == KCS_PLAYER_STOPPING;
  *pins->ticks = (hal_u32_t)report->ticks;
  *pins->starvations = (hal_u32_t)report->starvations;
  *pins->refused = (hal_u32_t)report->refused;
  for (uint32_t i = 0; i < output->marker_count; ++i) heed(&output->markers[i]);
  if (report->state == KCS_PLAYER_OFF || report->state == KCS_PLAYER_FAULT) {
    switch_spindle(false, false, 0);
    *pins->speed_limit = 0;
    *pins->mist = *pins->flood = false;
  }
}

static void tick(void *unused, long period_ns) {
  (void)unused;
  if (!started) {
    started = start(period_ns);
    *pins->bad_limits = !started;
    if (!started) return;
  }
  struct kcs_player_input input = {.enable = *pins->enable, .hold = *pins->hold, .drive_fault = *pins->drive_fault};
  for (int i = 0; i < axes; ++i) input.actual_mm[i] = *pins->axis[i].feedback;
  struct kcs_player_output output;
  kcs_player_tick(&player, &input, &output);
  tell(&output);
}

static int add_axis(struct axis_pins *axis, char letter) {
  int fault = hal_pin_float_newf(HAL_OUT, &axis->command, component, "kcs-player.%c.position-cmd", letter);
  fault |= hal_pin_float_newf(HAL_IN, &axis->feedback, component, "kcs-player.%c.position-fb", letter);
  fault |= hal_param_float_newf(HAL_RW, &axis->velocity, component, "kcs-player.%c.max-velocity", letter);
  fault |= hal_param_float_newf(HAL_RW, &axis->acceleration, component, "kcs-player.%c.max-acceleration", letter);
  fault |= hal_param_float_newf(HAL_RW, &axis->jerk, component, "kcs-player.%c.max-jerk", letter);
  fault |= hal_param_float_newf(HAL_RW, &axis->following_error, component, "kcs-player.%c.max-following-error", letter);
  return fault;
}

static int add_pins(void) {
  int fault = 0;
  for (int i = 0; i < axes; ++i) fault |= add_axis(&pins->axis[i], "xyz"[i]);
  fault |= hal_pin_bit_newf(HAL_IN, &pins->enable, component, "kcs-player.enable");
  fault |= hal_pin_bit_newf(HAL_IN, &pins->hold, component, "kcs-player.hold");
  fault |= hal_pin_bit_newf(HAL_IN, &pins->drive_fault, component, "kcs-player.drive-fault");
  fault |= hal_pin_bit_newf(HAL_OUT, &pins->drives_on, component, "kcs-player.drives-on");
  fault |= hal_pin_bit_newf(HAL_OUT, &pins->quick_stop, component, "kcs-player.quick-stop");
  fault |= hal_pin_bit_newf(HAL_OUT, &pins->running, component, "kcs-player.running");
  fault |= hal_pin_bit_newf(HAL_OUT, &pins->held, component, "kcs-player.held");
  fault |= hal_pin_bit_newf(HAL_OUT, &pins->moving, component, "kcs-player.moving");
  fault |= hal_pin_bit_newf(HAL_OUT, &pins->bad_limits, component, "kcs-player.bad-limits");
  fault |= hal_pin_bit_newf(HAL_OUT, &pins->spindle_on, component, "kcs-player.spindle-on");
  fault |= hal_pin_bit_newf(HAL_OUT, &pins->spindle_forward, component, "kcs-player.spindle-forward");
  fault |= hal_pin_float_newf(HAL_OUT, &pins->spindle_speed, component, "kcs-player.spindle-speed");
  fault |= hal_pin_float_newf(HAL_OUT, &pins->surface_speed, component, "kcs-player.surface-speed");
  fault |= hal_pin_float_newf(HAL_OUT, &pins->speed_limit, component, "kcs-player.speed-limit");
  fault |= hal_pin_bit_newf(HAL_OUT, &pins->mist, component, "kcs-player.mist");
  fault |= hal_pin_bit_newf(HAL_OUT, &pins->flood, component, "kcs-player.flood");
  fault |= hal_pin_s32_newf(HAL_OUT, &pins->state, component, "kcs-player.state");
  fault |= hal_pin_s32_newf(HAL_OUT, &pins->reason, component, "kcs-player.reason");
  fault |= hal_pin_u32_newf(HAL_OUT, &pins->ticks, component, "kcs-player.ticks");
  fault |= hal_pin_u32_newf(HAL_OUT, &pins->starvations, component, "kcs-player.starvations");
  fault |= hal_pin_u32_newf(HAL_OUT, &pins->refused, component, "kcs-player.refused");
  return fault;
}

int rtapi_app_main(void) {
  if (axes < 2 || axes > KCS_PLAYER_AXES) {
    rtapi_print_msg(RTAPI_MSG_ERR, "kcs_player: axes=%d, but it must be 2 or 3\n", axes);
    return -EINVAL;
  }
  const char *reason = kcs_open_shared_memory(&shared, name, group);
  if (reason) {
    rtapi_print_msg(RTAPI_MSG_ERR, "kcs_player: shared memory /kcs-%s: %s\n", name, reason);
    return -EINVAL;
  }
  component = hal_init("kcs_player");
  pins = component < 0 ? NULL : hal_malloc(sizeof *pins);
  if (!pins || add_pins() != 0 || hal_export_funct("kcs-player.tick", tick, NULL, 1, 0, component) != 0) {
    rtapi_print_msg(RTAPI_MSG_ERR, "kcs_player: HAL has no room for it, or has a kcs_player already\n");
    if (component >= 0) hal_exit(component);
    kcs_close_shared_memory(&shared);
    return -EINVAL;
  }
  return hal_ready(component);
}

void rtapi_app_exit(void) {
  hal_exit(component);
  kcs_close_shared_memory(&shared);
}
