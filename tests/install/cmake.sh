#!/usr/bin/env bash
# cmake.sh SOURCE WORK: the examples as a project that finds kcs by find_package().
set -euo pipefail
source "$(dirname "$0")/run_examples.sh"
examples=$2/cmake
rm -rf "$examples"
cmake -S "$1/client/examples" -B "$examples" -G Ninja -DCMAKE_PREFIX_PATH="$2/prefix" \
  -DCMAKE_CXX_COMPILER_LAUNCHER="$CCACHE" >/dev/null
cmake --build "$examples"
run_examples "$1" "$2/prefix" "$examples"
