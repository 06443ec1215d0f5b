#!/usr/bin/env bash
# The whole of kcs in a minute: a server on loopback, a real program planned by it, some seconds of it played by the
# machine gateway, and a picture. Started by ./run demo; its argument is the folder with the built programs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
programs=$1
program=deploy/demo/part.ngc
machine=deploy/machines/router.toml
out=build/demo
mkdir -p "$out"

step() { printf '\n== %s\n' "$*"; }

step "Starting kcsd on loopback"
"$programs/server/kcsd" --listen 127.0.0.1:0 --database memory >"$out/kcsd.out" 2>"$out/kcsd.log" &
server=$!
trap 'kill "$server" 2>/dev/null; wait "$server" 2>/dev/null || true' EXIT
for _ in {1..100}; do
  grep -q 'listens on' "$out/kcsd.out" && break
  kill -0 "$server" 2>/dev/null || { cat "$out/kcsd.log" >&2; exit 1; }
  sleep 0.05
done
address=$(sed -n 's/^kcsd listens on //p' "$out/kcsd.out")
echo "kcsd serves at $address (process $server, log in $out/kcsd.log)"

common=(--server "$address" --machine "$machine" --tolerance 0.02)

step "Planning $program for the machine of $machine"
"$programs/client/cli/kcsctl" plan "${common[@]}" "$program"

step "Playing the first 5 seconds into simulated drives"
"$programs/client/gateway/kcs-gateway" "${common[@]}" --seconds 5 "$program"

step "Writing setpoints and a picture"
"$programs/client/cli/kcsctl" stream "${common[@]}" --period 0.004 "$program" -o "$out/setpoints.csv"
"$programs/client/cli/kcsctl" plot "${common[@]}" "$program" -o "$out/part.svg"
"$programs/client/cli/kcsctl" plot "${common[@]}" --from 172 --to 174 "$program" -o "$out/two-seconds.svg"

step "Done; look at"
printf '%s\n' "$out/part.svg          path, speed, acceleration and jerk" \
  "$out/two-seconds.svg   the same of two seconds in a pocket" \
  "$out/setpoints.csv     a setpoint every 4 ms" \
  "$out/kcsd.log          what the server did"
