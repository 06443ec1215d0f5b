#!/bin/sh
# run.sh COMMAND…: runs the command if there is a FreeCAD, or says that there is none (exit code 77).
if ! command -v freecadcmd >/dev/null; then
  echo "skipped: freecadcmd is not installed; ./run test freecad installs it"
  exit 77
fi
exec "$@"
