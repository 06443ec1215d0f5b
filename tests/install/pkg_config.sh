#!/usr/bin/env bash
# pkg_config.sh SOURCE WORK: the examples by a compiler command line that pkg-config makes.
set -euo pipefail
source "$(dirname "$0")/run_examples.sh"
examples=$2/pkg_config
rm -rf "$examples"
mkdir -p "$examples"
export PKG_CONFIG_PATH=$2/prefix/lib/pkgconfig
build() {
  local cflags libs
  read -ra cflags < <(pkg-config --cflags "$2")
  read -ra libs < <(pkg-config --libs "$2")
  "$CXX" -std=c++20 "${cflags[@]}" "$source/client/examples/$1.cpp" -o "$examples/$1" "${libs[@]}"
}
source=$1
build plan_a_path kcs-client
build plan_in_process kcs-planning
run_examples "$1" "$2/prefix" "$examples"
