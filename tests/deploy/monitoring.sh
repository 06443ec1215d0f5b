#!/usr/bin/env bash
# monitoring.sh DEPLOY SCRATCH: Prometheus takes its settings, with the alerts beside them as compose.yaml puts them.
set -euo pipefail
source "$(dirname "$0")/needs.sh"
needs_program promtool prometheus
mkdir -p "$2"
cp "$1/compose/prometheus.yml" "$1/alerts.yml" "$2"
promtool check config "$2/prometheus.yml"
