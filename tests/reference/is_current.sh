#!/usr/bin/env bash
# is_current.sh PROTO: whether REFERENCE.md is what ./run reference would write.
set -euo pipefail
cd "$1"
/usr/bin/python3 -c 'import google.protobuf' || { echo "skipped: Debian's python3-protobuf is not here"; exit 77; }
diff -u REFERENCE.md <(./reference.py kcs/v1/*.proto) || { echo "write it anew: ./run reference"; exit 1; }
