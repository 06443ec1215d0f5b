#!/usr/bin/env bash
# Keeps the contract of the version that is about to be released as released/VERSION.binpb, compiled, with all that it
# imports. From then on contract_test compares every later contract with it. Needs Debian's protobuf-compiler.
#
#   tests/contract/release.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
version=$(sed -n 's/^project(kcs VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
file=tests/contract/released/$version.binpb
if [[ -e $file ]]; then
  echo "release.sh: $file is there, and what was released does not change: raise the version in CMakeLists.txt" >&2
  exit 1
fi
protoc --proto_path=proto --include_imports --descriptor_set_out="$file" \
  kcs/v1/planning.proto kcs/v1/machine.proto kcs/stored/v1/request.proto google/rpc/error_details.proto
echo "wrote $file"
