"""The report on a posted program."""

import kcs


def describe(program, plan, spots):
    """Cycle time, slow spots with the operations that they belong to, and notices, as text.

    program: the pathlib.Path of the posted file. plan: its kcs.Plan. spots: how many of them at most.
    """
    operations = _operations(program.read_text(encoding="utf-8", errors="replace"))
    sections = [
        f"kcs: {program} on {plan.machine.name or 'the machine'}, tolerance {plan.tolerance_mm:g} mm",
        str(plan.summary),
    ]
    slow = kcs.slowest_spots(plan.corners(), spots)
    if len(slow):
        sections += ["", "Slowest spots", _heading(plan.machine.axes)]
        sections += [_row(spot, operations.get(spot["line"], "")) for spot in slow]
    if plan.notices:
        sections += ["", "Notices", *(f"  {notice}" for notice in plan.notices)]
    return "\n".join(sections) + "\n"


def _operations(gcode):
    """The operation that each line belongs to, by the comments of the post-processor."""
    begin, end = "(begin operation: ", "(finish operation: "
    operations, current = {}, ""
    for number, line in enumerate(gcode.splitlines(), start=1):
        if begin in line:
            current = line.partition(begin)[2].rstrip(")")
        operations[number] = current
        if end in line:
            current = ""
    return operations


def _heading(axes):
    names = "".join(f"{name + ' mm':>11}" for name in "XYZ"[:axes])
    return f"    line{names}  corners  slowest mm/s  lost s  operation"


def _row(spot, operation):
    point = "".join(f"{coordinate:11.3f}" for coordinate in spot["point_mm"])
    figures = f"{spot['corners']:9}{spot['lowest_speed_mm_s']:14.2f}{spot['time_lost_s']:8.3f}"
    return f"{spot['line']:8}{point}{figures}  {operation}".rstrip()
