#!/bin/sh
# run.sh PYTHON TEST: runs tests of the Python package, or says what is missing for that (exit code 77).
python=$1
shift
for module in grpc google.protobuf numpy pytest; do
  if ! "$python" -c "import $module" 2>/dev/null; then
    echo "skipped: $python has no module $module (Debian: python3-grpcio python3-protobuf python3-numpy python3-pytest)"
    exit 77
  fi
done
exec "$python" -m pytest -q -rs -p no:cacheprovider "$@"
