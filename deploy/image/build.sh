#!/usr/bin/env bash
# Builds the container image "kcs" and tries it: ./run image
# With Docker or Podman, whichever is there. Without either, Podman is installed, and where no image registry is within
# reach, the Debian that the image is built on comes from the machine's own package sources. Exit code 77: it cannot be
# built on this machine, and the reason is told.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source deploy/image/engine.sh

version=$(sed -n 's/^project(kcs VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
revision=$(git rev-parse HEAD 2>/dev/null || echo unknown)
give_up() {
  say "cannot be built here: $*"
  exit 77
}
base=$(base_image) || give_up "there is no Debian to build it on, from an image registry or from package sources"
run_image --rm "$base" true || give_up "$engine runs no containers on this machine; its reason is above"

say "building kcs:$version on $base"
build_image --build-arg "BASE=$base" --build-arg "VERSION=$version" --build-arg "REVISION=$revision" \
  --tag "kcs:$version" --tag kcs:latest

size=$(engine image inspect --format '{{.Size}}' "kcs:$version")
say "kcs:$version is $((size / 1000000)) MB"
if ((size > 150000000)); then
  say "that is more than the 150 MB that it may be"
  exit 1
fi
deploy/image/try.sh "kcs:$version"
