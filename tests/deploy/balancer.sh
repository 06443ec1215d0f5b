#!/usr/bin/env bash
# balancer.sh HAPROXY_CFG SCRATCH: HAProxy takes the balancer's settings, and without a warning.
set -euo pipefail
source "$(dirname "$0")/needs.sh"
needs_program haproxy haproxy
needs_program openssl openssl
mkdir -p "$2"
openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -subj /CN=test -days 1 \
  -keyout "$2/tls.key" -out "$2/tls.crt" 2>"$2/openssl.log" || { cat "$2/openssl.log"; exit 1; }
cp "$2/tls.crt" "$2/ca.crt"
sed "s|/certificates/|$2/|g" "$1" >"$2/haproxy.cfg"
haproxy -c -dW -f "$2/haproxy.cfg"
