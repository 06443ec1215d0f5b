# Sourced. run_examples SOURCE PREFIX EXAMPLES: runs the built examples, one of them against an installed server.
run_examples() {
  local program=$1/tests/data/zigzag.nc prefix=$2 examples=$3 server address
  "$prefix/bin/kcsd" --listen 127.0.0.1:0 --database memory >"$examples/kcsd.out" 2>"$examples/kcsd.log" &
  server=$!
  # shellcheck disable=SC2064  # it is this server that is to be stopped
  trap "kill $server; wait $server || true" EXIT
  for _ in {1..1200}; do
    address=$(sed -n 's/^kcsd listens on //p' "$examples/kcsd.out")
    [[ -z $address ]] || break
    kill -0 "$server" || { cat "$examples/kcsd.log"; return 1; }
    sleep 0.05
  done
  expect '6 corners' "$examples/plan_a_path" "$address" "$program"
  expect '[0-9]+ setpoints' "$examples/plan_a_path" "$address" "$program"
  expect '6 corners' "$examples/plan_in_process" "$program"
  expect '2 +62 +0 mm at 0 mm/s' "$examples/plan_in_process" "$program"
}

# expect PATTERN COMMAND…: fails unless the command succeeds and prints it.
expect() {
  local output
  output=$("${@:2}") || return
  grep -qE "$1" <<<"$output" || { printf '%s says not "%s" but:\n%s\n' "$2" "$1" "$output"; return 1; }
}
