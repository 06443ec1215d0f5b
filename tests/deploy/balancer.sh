#!/usr/bin/env bash
# balancer.sh HAPROXY_CFG: HAProxy takes the balancer's settings, and without a warning.
set -euo pipefail
source "$(dirname "$0")/needs.sh"
needs_program haproxy haproxy
haproxy -c -dW -f "$1"
