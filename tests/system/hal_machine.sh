#!/bin/sh
# hal_machine.sh FOLDER USER: runs LinuxCNC's HAL, without LinuxCNC and without hardware, in namespaces of its own, with
# FOLDER/modules in place of LinuxCNC's modules: first FOLDER/machine.hal, then FOLDER/record.hal. Says "ready" and writes
# samples to FOLDER/samples until it is sent TERM, which ends all of it. Started by root, for the namespaces; HAL runs as
# the user with that number, for it refuses root.
set -eu
part=${3:-outside}
case $part in
  outside)
    exec unshare --ipc --mount --pid --fork --kill-child --mount-proc "$0" "$1" "$2" inside
    ;;
  inside)
    mount -t tmpfs -o mode=1777 none /dev/shm
    mount --bind "$1/modules" /usr/lib/linuxcnc/modules
    exec setpriv --pdeathsig=KILL --reuid="$2" --regid="$2" --clear-groups "$0" "$1" "$2" user
    ;;
  user)
    cd "$1"
    export HOME="$1"
    /usr/lib/linuxcnc/realtime start >log 2>&1
    halcmd -f machine.hal >>log 2>&1
    halcmd -f record.hal >>log 2>&1
    echo ready
    exec halsampler >samples 2>>log
    ;;
esac
