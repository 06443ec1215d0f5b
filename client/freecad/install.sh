#!/bin/sh
# install.sh [FOLDER]: puts post-processor, macro and Python package into FreeCAD's macro folder, where FreeCAD finds all
# of them. FOLDER: another macro folder than the default one.
set -eu
cd "$(dirname "$0")"
if [ $# -gt 0 ]; then
  folder=$1
else
  folder=$(freecadcmd -c 'import FreeCAD; print("folder=" + FreeCAD.getUserMacroDir(True))' </dev/null | sed -n 's/^folder=//p')
fi
mkdir -p "$folder"
cp kcs_post.py kcs_report.py kcs_cycle_time.FCMacro "$folder"
rm -rf "$folder/kcs"
cp -rL ../python/kcs "$folder/kcs"
echo "installed in $folder"
