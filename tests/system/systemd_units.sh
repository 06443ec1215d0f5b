#!/usr/bin/env bash
# Has systemd check the units: systemd_units.sh UNITS KCSD SCRATCH. The program's place is put in, as systemd wants to
# find it; all else is checked as it is shipped.
set -euo pipefail
units=$1 kcsd=$2 scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch"
cp "$units"/kcsd.service "$units"/kcsd.socket "$scratch"
sed -i "s|^ExecStart=/usr/bin/kcsd |ExecStart=$kcsd |" "$scratch/kcsd.service"
grep -q "^ExecStart=$kcsd " "$scratch/kcsd.service"
said=$(SYSTEMD_LOG_LEVEL=warning systemd-analyze verify --man=no --recursive-errors=no "$scratch"/kcsd.service "$scratch"/kcsd.socket 2>&1)
if [[ -n $said ]]; then
  printf '%s\n' "$said"
  exit 1
fi
