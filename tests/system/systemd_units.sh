#!/usr/bin/env bash
# Has systemd check the units: systemd_units.sh UNITS KCSD KCS_GATEWAY SCRATCH. The programs' places are put in, as systemd
# wants to find them; all else is checked as it is shipped.
set -euo pipefail
units=$1 kcsd=$2 gateway=$3 scratch=$4
rm -rf "$scratch"
mkdir -p "$scratch"
cp "$units"/kcsd.service "$units"/kcsd.socket "$scratch"
cp "$units/kcs-gateway@.service" "$scratch/kcs-gateway@mill.service"

# name_program UNIT PROGRAM PATH
name_program() {
  sed -i "s|^ExecStart=/usr/bin/$2 |ExecStart=$3 |" "$scratch/$1"
  grep -q "^ExecStart=$3 " "$scratch/$1"
}
name_program kcsd.service kcsd "$kcsd"
name_program kcs-gateway@mill.service kcs-gateway "$gateway"

said=$(SYSTEMD_LOG_LEVEL=warning systemd-analyze verify --man=no --recursive-errors=no "$scratch"/*.service "$scratch"/*.socket 2>&1)
if [[ -n $said ]]; then
  printf '%s\n' "$said"
  exit 1
fi
