#!/usr/bin/env bash
# compose.sh DEPLOY: docker-compose takes the file for the containers of one machine.
set -euo pipefail
source "$(dirname "$0")/needs.sh"
needs_program docker-compose docker-compose
cd "$1/compose"
# Debian 12 has version 1.29, of before "name:" was a key. It says, too, that it cannot do "configs:" without a swarm.
if ! said=$(grep -v '^name: kcs$' compose.yaml | docker-compose --project-directory . -f - config --quiet 2>&1); then
  echo "docker-compose refuses deploy/compose/compose.yaml:"
  echo "$said"
  exit 1
fi
