#!/usr/bin/env bash
# Builds the Debian packages and tries them in a bare Debian: ./run package
# They lie in build/release then.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source deploy/image/engine.sh

./run build
rm -f build/release/*.deb
(cd build/release && cpack >/dev/null)
packages=(build/release/*.deb)
say "built ${packages[*]}"

base=$(base_image)
engine run --rm --network host "${run_limits[@]}" --volume "$PWD/build/release:/packages:ro" \
  --volume /etc/apt/apt.conf.d:/etc/apt/apt.conf.d:ro --volume "$PWD/tests/data:/data:ro" --volume "$PWD/deploy/package:/try:ro" \
  "$base" /try/try.sh
