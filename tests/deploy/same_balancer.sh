#!/usr/bin/env bash
# same_balancer.sh DEPLOY: the balancer for Kubernetes is that of compose, which cluster_test tries, but for TLS, the names
# and number of the servers, and its own health.
set -euo pipefail
without_comments() { grep -vE '^ *(#|$)' "$1"; }
of_kubernetes=$(without_comments "$1/kubernetes/haproxy.cfg" | sed -E '
  s/ (no-check-ssl )?ssl crt .* alpn h2/ proto h2/
  s/^resolvers cluster$/resolvers containers/; s/ resolvers cluster / resolvers containers /
  s/kcsd 12 kcsd\.kcs\.svc\.cluster\.local:/kcsd 10 kcsd:/
  /^  (ssl-load-extra-del-ext|accepted_payload_size .*|monitor-uri .*)$/d')
if ! diff <(without_comments "$1/compose/haproxy.cfg") - <<<"$of_kubernetes"; then
  echo "deploy/compose/haproxy.cfg (<) and deploy/kubernetes/haproxy.cfg (>) differ in more than they must"
  exit 1
fi
