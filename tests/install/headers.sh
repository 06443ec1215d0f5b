#!/usr/bin/env bash
# headers.sh SOURCE WORK: the installed headers compile, and need neither protobuf nor gRPC nor the repository.
set -euo pipefail
cd "$2/prefix/include"
read -ra eigen < <(pkg-config --cflags eigen3)
needed=$(printf '#include <%s>\n' kcs/*/*.h |
  "$CXX" -std=c++20 -Wall -Wextra -Werror -I. "${eigen[@]}" -x c++ -fsyntax-only -H - 2>&1) || {
  printf 'the installed headers do not compile:\n%s\n' "$needed"
  exit 1
}
if grep -E 'google/protobuf|grpc|\.pb\.h' <<<"$needed"; then
  echo "users of kcs need not have the headers above, yet a header of kcs includes them"
  exit 1
fi
