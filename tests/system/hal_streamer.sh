#!/usr/bin/env bash
# hal_streamer.sh KCSCTL PROGRAM: LinuxCNC's own halstreamer plays what `kcsctl stream -o X.hal` writes, and its
# sampler records the same positions. 77: there is no LinuxCNC, or nobody who may make namespaces.
set -euo pipefail
kcsctl=$1 program=$2 part=${3:-outside} folder=${4:-}
user=20001  # HAL refuses root
case $part in
  outside)
    [[ -x /usr/bin/halstreamer ]] || { echo "skipped: LinuxCNC is not here (./run test hal installs it)"; exit 77; }
    ((EUID == 0)) || { echo "skipped: only root may make the namespaces in which HAL is alone"; exit 77; }
    folder=$(mktemp -d)  # where any user may come by
    trap 'rm -rf "$folder"' EXIT
    "$kcsctl" stream "$program" -o "$folder/setpoints.hal" 2>"$folder/kcsctl.log"
    chown -R "$user:$user" "$folder"
    unshare --ipc --mount --pid --fork --kill-child --mount-proc "$0" "$1" "$2" inside "$folder" || {
      cat "$folder/log"
      exit 1
    }
    ;;
  inside)
    mount -t tmpfs -o mode=1777 none /dev/shm
    cp "$0" /dev/shm/hal_streamer.sh  # the user may not come by where it lies
    exec setpriv --reuid="$user" --regid="$user" --clear-groups bash /dev/shm/hal_streamer.sh "$1" "$2" user "$folder"
    ;;
  user)
    cd "$folder"
    export HOME=$folder
    setpoints=$(wc -l <setpoints.hal)
    cat >machine.hal <<HAL
loadrt threads name1=servo period1=1000000
loadrt streamer depth=$((setpoints + 100)) cfg=fff
loadrt sampler depth=$((setpoints + 100)) cfg=fff
addf streamer.0 servo
addf sampler.0 servo
net x streamer.0.pin.0 sampler.0.pin.0
net y streamer.0.pin.1 sampler.0.pin.1
net z streamer.0.pin.2 sampler.0.pin.2
HAL
    /usr/lib/linuxcnc/realtime start >log 2>&1
    halcmd -f machine.hal >>log 2>&1
    timeout 60 halstreamer <setpoints.hal >>log 2>&1
    timeout 120 halsampler -n "$setpoints" >samples 2>>log &
    halcmd start >>log 2>&1
    wait $!
    # halsampler writes six digits after the point.
    paste -d ' ' setpoints.hal samples | awk '
      { for (i = 1; i <= 3; ++i) if ($i - $(i + 3) > 1e-6 || $(i + 3) - $i > 1e-6) { print NR ": " $0; exit 1 } }
      END { print NR " setpoints were played" }'
    ;;
esac
