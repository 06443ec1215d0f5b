#!/usr/bin/env bash
# kubernetes.sh PYTHON TEST: runs a test of the files for Kubernetes.
set -euo pipefail
here=$(dirname "$0")
source "$here/needs.sh"
needs_program kubectl kubernetes-client
needs_module "$1" kubernetes python3-kubernetes
needs_module "$1" yaml python3-yaml
needs_module "$1" pytest python3-pytest
exec "$1" -m pytest -q -p no:cacheprovider "$here/$2"
