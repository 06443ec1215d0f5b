#!/usr/bin/env bash
# install.sh CMAKE BUILD PREFIX: installs a build into a folder that is emptied before.
set -euo pipefail
rm -rf "$3"
"$1" --install "$2" --prefix "$3" >/dev/null
cd "$3"
for file in bin/kcsd bin/kcsctl bin/kcs-gateway include/kcs/client/planner.h include/kcs/planning/plan_path.h \
  share/kcs/proto/kcs/v1/planning.proto lib/libkcs_client.a; do
  [[ -s $file ]] || { echo "$file is not installed" >&2; exit 1; }
done
./bin/kcsd --version
