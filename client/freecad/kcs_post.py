"""A post-processor for FreeCAD's Path workbench: LinuxCNC's G-code, and what it costs on a machine that is limited in
jerk.

Writes what FreeCAD's own linuxcnc post-processor writes, sends it to kcs, and shows cycle time and slow spots in the
report view and in a text file beside the program: part.ngc, part.kcs.txt.
"""

import argparse
import importlib
import pathlib
import shlex

import FreeCAD
import kcs
from PathScripts.post import linuxcnc_post

import kcs_report

# FreeCAD shows these where the post-processor is chosen.
TOOLTIP = __doc__
UNITS = linuxcnc_post.UNITS
MACHINE_NAME = "LinuxCNC"

_parser = argparse.ArgumentParser(prog="kcs", add_help=False, allow_abbrev=False, exit_on_error=False)
_parser.add_argument("--machine", default="router", help="kcs: a machine profile by name, or its TOML file [router]")
_parser.add_argument("--tolerance", type=float, help="kcs: how far the tool may leave the path at a corner, mm [0.01]")
_parser.add_argument("--server", help="kcs: HOST:PORT or unix:PATH of a kcsd that runs [one is started for each job]")
_parser.add_argument("--spots", type=int, default=10, help="kcs: how many slow spots are shown [10]")

TOOLTIP_ARGS = _parser.format_help() + "\nAll others are those of linuxcnc:\n" + linuxcnc_post.TOOLTIP_ARGS


def export(objectslist, filename, argstring):
    """Called by FreeCAD. Returns the G-code; None if linuxcnc's post-processor refuses. A failure of kcs is reported,
    and takes nothing from the G-code.
    """
    try:
        own, others = _parser.parse_known_args(shlex.split(argstring))
    except (argparse.ArgumentError, ValueError) as failure:
        FreeCAD.Console.PrintError(f"kcs: {failure}\n")
        return None
    # It keeps the arguments of the call before, so that each needs one that is new.
    gcode = importlib.reload(linuxcnc_post).export(objectslist, filename, shlex.join(others))
    if gcode is not None and filename != "-":  # that one asks for the text alone
        _report(pathlib.Path(filename), own)
    return gcode


def _report(program, arguments):
    try:
        with kcs.Client(arguments.server) as client:
            plan = client.plan(gcode=program, machine=arguments.machine, tolerance=arguments.tolerance)
            text = kcs_report.describe(program, plan, arguments.spots)
        program.with_suffix(".kcs.txt").write_text(text, encoding="utf-8")
    except (kcs.Error, kcs.ServerNotFound, OSError, ValueError) as failure:
        FreeCAD.Console.PrintError(f"kcs: no cycle time: {failure}\n")
    else:
        FreeCAD.Console.PrintMessage(text)
