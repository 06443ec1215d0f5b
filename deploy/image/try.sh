#!/usr/bin/env bash
# Tries an image as its users would: it becomes healthy, plans and streams over TLS, keeps its plans over a restart, and
# SIGTERM lets a running stream end before kcsd stops with code 0.   deploy/image/try.sh IMAGE
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source deploy/image/engine.sh
image=$1
name=kcs-try-$$
folder=$(mktemp -d)
server=(--listen 127.0.0.1:50561 --http-listen 127.0.0.1:50562)
client=(--server 127.0.0.1:50561 --tls-ca /try/ca.pem)

clean_up() {
  engine rm --force "$name" >/dev/null 2>&1 || true
  engine volume rm "$name" >/dev/null 2>&1 || true
  rm -rf "$folder"
}
trap clean_up EXIT

fail() {
  say "FAILED: $*"
  engine logs "$name" 2>&1 | tail -n 20 >&2
  exit 1
}

start() {
  engine rm --force "$name" >/dev/null 2>&1 || true
  run_image --detach --name "$name" --volume "$folder:/etc/kcs:ro" --volume "$name:/var/lib/kcs" \
    "$image" --config /etc/kcs/kcsd.toml "${server[@]}" >/dev/null
  local attempt
  for attempt in {1..100}; do
    if engine exec "$name" /usr/bin/kcsctl health --http 127.0.0.1:50562 >/dev/null 2>&1; then return; fi
    sleep 0.2
  done
  fail "it does not become healthy"
}

# SIGTERM; its exit code must be 0.
stop() {
  engine stop --time 30 "$name" >/dev/null
  local code
  code=$(engine inspect --format '{{.State.ExitCode}}' "$name")
  [[ $code == 0 ]] || fail "SIGTERM ended it with code $code"
}

kcsctl() {
  run_image --rm --interactive --volume "$folder:/try:ro" --entrypoint /usr/bin/kcsctl "$image" "$@"
}

openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj '/CN=localhost' \
  -addext 'subjectAltName=IP:127.0.0.1' -keyout "$folder/key.pem" -out "$folder/ca.pem" 2>/dev/null
printf '[security]\ncertificate = "/etc/kcs/ca.pem"\nkey = "/etc/kcs/key.pem"\n' >"$folder/kcsd.toml"
cp deploy/demo/part.ngc "$folder"
chmod 755 "$folder"
chmod 644 "$folder"/*

if engine run --rm --entrypoint /bin/sh "$image" -c true 2>/dev/null; then fail "there is a shell in it"; fi

start
kcsctl plan /try/part.ngc "${client[@]}" --json >"$folder/first.json" || fail "it does not plan"
kcsctl stream /try/part.ngc "${client[@]}" --period 0.01 -o - >"$folder/first.csv" || fail "it does not stream"

# A reader that rests for some seconds keeps a stream of many megabytes open; SIGTERM comes meanwhile.
kcsctl stream /try/part.ngc "${client[@]}" --period 0.001 -o - | { sleep 4 && cat; } >"$folder/long.csv" &
reader=$!
sleep 2
stop
wait "$reader" || fail "SIGTERM broke off a running stream"
(($(wc -l <"$folder/long.csv") > 10 * ($(wc -l <"$folder/first.csv") - 12))) || fail "a stream lost its end"

start
kcsctl plan /try/part.ngc "${client[@]}" --json >"$folder/second.json" || fail "it does not plan after a restart"
kcsctl stream /try/part.ngc "${client[@]}" --period 0.01 -o - >"$folder/second.csv" || fail "it does not stream after a restart"
cmp "$folder/first.csv" "$folder/second.csv" || fail "the same program gave other setpoints"
stop
say "good: healthy, planned and streamed $(($(wc -l <"$folder/first.csv") - 1)) setpoints over TLS, stopped in order, and gave the same bytes again"
