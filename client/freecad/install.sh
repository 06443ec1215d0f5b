#!/bin/sh
# install.sh [FOLDER]: puts post-processor, macro and Python package into FreeCAD's macro folder, where FreeCAD finds all
# of them. FOLDER: another macro folder than the default one.
set -eu
here=$(dirname "$0")
if [ $# -gt 0 ]; then
  folder=$1
elif command -v freecadcmd >/dev/null; then
  ask='import FreeCAD; print("folder=" + FreeCAD.getUserMacroDir(True))'
  folder=$(freecadcmd -c "$ask" </dev/null | sed -n 's/^folder=//p')
else
  echo "freecadcmd is not on the PATH: name the macro folder (FreeCAD: Macro → Macros… shows it), or install freecad" >&2
  exit 1
fi
mkdir -p "$folder"
cp "$here/kcs_post.py" "$here/kcs_report.py" "$here/kcs_cycle_time.FCMacro" "$folder"
rm -rf "$folder/kcs"
cp -rL "$here/../python/kcs" "$folder/kcs"
echo "installed in $folder"
