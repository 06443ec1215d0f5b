#include "client/gateway/machine/words.h"

#include "client/gateway/player/player.h"

namespace kcs::gateway {

v1::MachineState to_message(std::uint32_t state) {
  switch (state) {
    case KCS_PLAYER_READY:
      return v1::MACHINE_STATE_READY;
    case KCS_PLAYER_RUNNING:
      return v1::MACHINE_STATE_RUNNING;
    case KCS_PLAYER_STOPPING:
      return v1::MACHINE_STATE_STOPPING;
    case KCS_PLAYER_HELD:
      return v1::MACHINE_STATE_HELD;
    case KCS_PLAYER_FAULT:
      return v1::MACHINE_STATE_FAULT;
    default:
      return v1::MACHINE_STATE_SWITCHED_OFF;
  }
}

std::string_view name_of(v1::MachineState state) {
  return std::string_view(v1::MachineState_Name(state)).substr(std::string_view("MACHINE_STATE_").size());
}

std::string_view describe_reason(std::uint32_t reason) {
  switch (reason) {
    case KCS_PLAYER_NONE:
      return "";
    case KCS_PLAYER_END:
      return "the end of the run is out";
    case KCS_PLAYER_ASKED:
      return "it was asked to stop";
    case KCS_PLAYER_STARVED:
      return "no batch was there when one was due: the connection or the server is too slow";
    case KCS_PLAYER_OUT_OF_ORDER:
      return "the player refused a batch that does not go on where the one before it ends";
    case KCS_PLAYER_MALFORMED:
      return "the player refused a malformed batch";
    case KCS_PLAYER_TOO_FAST:
      return "the player refused a batch that breaks a velocity limit of the machine";
    case KCS_PLAYER_TOO_STRONG:
      return "the player refused a batch that breaks an acceleration limit of the machine";
    case KCS_PLAYER_TOO_JERKY:
      return "the player refused a batch that breaks a jerk limit of the machine";
    case KCS_PLAYER_NOT_AT_REST:
      return "the player refused a batch whose stop tail does not end at rest";
    case KCS_PLAYER_DRIVE_FAULT:
      return "a drive reports a fault; look at the drive, then switch the machine off and on";
    case KCS_PLAYER_FOLLOWING_ERROR:
      return "an axis did not follow; see what holds it, then switch the machine off and on";
    case KCS_PLAYER_SWITCHED_OFF:
      return "the machine was switched off while it moved";
    default:
      return "for a reason that this gateway does not know; is the player of another version?";
  }
}

}  // namespace kcs::gateway
