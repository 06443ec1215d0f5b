#!/usr/bin/python3
"""Prints the moves of a G-code program as LinuxCNC's interpreter gives them.

It is the interpreter behind rs274 -g, which prints four decimals only; here every digit comes out. One move a line, in
machine coordinates, mm:

    line LINE X Y Z
    arc LINE X Y Z  CENTRE_X CENTRE_Y CENTRE_Z  NORMAL TURNS

NORMAL is the axis about which the arc turns (0 is X), TURNS > 0 counterclockwise. A line "not MOTION" says that the
program has something else than moves of three axes; "error TEXT" that the interpreter refuses the program.
"""

import ctypes
import math
import os
import sys
import tempfile

import gcode

INCH = 25.4  # the module states lengths in inches
PLANES = {1: (0, 1, 2), 2: (1, 2, 0), 3: (2, 0, 1)}  # XY, YZ, ZX: first and second axis, and the normal one


class Canon:
    """What the interpreter calls while it reads."""

    def __init__(self, parameter_file):
        self.parameter_file = parameter_file
        self.line = 0
        self.work = self.local = self.tool = (0.0, 0.0, 0.0)
        self.turn = (1.0, 0.0)
        self.plane = PLANES[1]

    def next_line(self, state):
        self.line = state.sequence_number

    def set_g5x_offset(self, _index, *offset):
        self.work = offset[:3]

    def set_g92_offset(self, *offset):
        self.local = offset[:3]

    def set_xy_rotation(self, degrees):
        self.turn = (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))

    def tool_offset(self, *offset):
        self.tool = offset[:3]

    def set_plane(self, plane):
        if plane in PLANES:
            self.plane = PLANES[plane]
        else:
            print("not a plane of X, Y and Z")

    def machine(self, point):
        x, y, z = (a + b for a, b in zip(point, self.local))
        cosine, sine = self.turn
        turned = (x * cosine - y * sine, x * sine + y * cosine, z)
        return tuple((a + b + c) * INCH for a, b, c in zip(turned, self.work, self.tool))

    def straight_traverse(self, *point):
        if any(point[3:]):
            print("not an axis beside X, Y and Z")
        print("line", self.line, *map(repr, self.machine(point[:3])))

    straight_feed = straight_traverse

    def arc_feed(self, first, second, centre_first, centre_second, turns, along, *others):
        if any(others):
            print("not an axis beside X, Y and Z")
        end = [0.0] * 3
        centre = [0.0] * 3
        end[self.plane[0]], end[self.plane[1]], end[self.plane[2]] = first, second, along
        centre[self.plane[0]], centre[self.plane[1]] = centre_first, centre_second
        points = map(repr, self.machine(end) + self.machine(centre))
        print("arc", self.line, *points, self.plane[2], turns)

    def straight_probe(self, *_):
        print("not probing")

    def rigid_tap(self, *_):
        print("not tapping")

    def user_defined_function(self, number, *_):
        print("not M%d" % (number + 100))

    def get_tool(self, _pocket):
        return (-1,) + (0.0,) * 12 + (0,)

    def get_external_angular_units(self):
        return 1.0

    def get_external_length_units(self):
        return 1.0

    def get_axis_mask(self):
        return 0b111111111

    def get_block_delete(self):
        return True

    def __getattr__(self, _name):
        return lambda *_: 0


TOOLS = 99


def create_tool_table(folder):
    """Tools of no length. They lie in the home folder, where those of a running machine must stay as they are."""
    os.environ["HOME"] = folder
    tools = ctypes.CDLL("libtooldata.so.0")
    tools._Z17tool_mmap_creatorPK13EMC_TOOL_STATi(None, 0)
    tools._Z13tooldata_initb(False)
    table = os.path.join(folder, "tool.tbl")
    with open(table, "w") as file:
        file.writelines("T%d P%d\n" % (number, number) for number in range(1, TOOLS + 1))
    tools._Z13tooldata_loadPKcPPc(table.encode(), None)


def main():
    with tempfile.TemporaryDirectory() as folder:
        create_tool_table(folder)
        parameters = os.path.join(folder, "parameters.var")
        with open(parameters, "w"):
            pass
        result, line = gcode.parse(sys.argv[1], Canon(parameters), "G21", "")
    if result > gcode.MIN_ERROR:
        print("error line %d: %s" % (line, gcode.strerror(result)))


main()
