#!/bin/sh
# Makes kcs/contract.binpb from the files of the contract anew, after one of them has changed. Needs protoc.
set -eu
cd "$(dirname "$0")"
protoc --proto_path=../../proto --include_imports --descriptor_set_out="${1:-kcs/contract.binpb}" \
  kcs/v1/planning.proto google/rpc/error_details.proto
