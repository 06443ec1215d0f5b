"""Plans a program and draws it: where the time goes, and how the machine moves.

    python picture.py [PROGRAM [MACHINE]]

Without arguments: a rounded star, made from points here. Writes plan.png.
"""

import sys
from pathlib import Path

import kcs
import numpy as np


def star(points: int = 2000) -> np.ndarray:
    """A closed curve with five lobes, shape (points, 3), mm."""
    angle = np.linspace(0, 2 * np.pi, points)
    radius = 30 + 10 * np.cos(5 * angle)
    return np.column_stack((radius * np.cos(angle), radius * np.sin(angle), np.zeros(points)))


def main() -> None:
    machine = sys.argv[2] if len(sys.argv) > 2 else "router"
    with kcs.Client() as client:
        if len(sys.argv) > 1:
            plan = client.plan(gcode=Path(sys.argv[1]), machine=machine, tolerance=0.02)
        else:
            plan = client.plan(points=star(), machine=machine, tolerance=0.02, feed=120)
        print(plan.summary)
        for spot in kcs.slowest_spots(plan.corners(), 3):
            line = f"line {spot['line']}, " if spot["line"] else ""
            print(f"slow at {line}{spot['point_mm'].round(2)} mm: {spot['time_lost_s']:.3f} s lost")
        plan.plot("plan.png")
        print("plan.png shows it")


if __name__ == "__main__":
    main()
