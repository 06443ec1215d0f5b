"""Plans how machine tools move: cycle times, slow spots and setpoints of a tool path.

    import kcs, pathlib

    plan = kcs.Client().plan(gcode=pathlib.Path("part.nc"), machine="router", tolerance=0.02)
    print(plan.summary)                     # cycle time, where it goes
    plan.corners()                          # every corner, what it costs: a structured array
    plan.setpoints(0.001).position_mm       # shape (n, axes), mm
    plan.plot("part.png")                   # the path coloured by speed

Millimetres, seconds, and what follows from them; axes in the order X, Y, Z.
"""

from kcs import aio
from kcs.client import Client, Plan
from kcs.connection import Connection
from kcs.corners import slowest_spots
from kcs.errors import Error, ServerNotFound, Violation
from kcs.machine import Machine, shipped_machines
from kcs.setpoints import Setpoints
from kcs.summary import Notice, Summary

__all__ = [
    "Client",
    "Connection",
    "Error",
    "Machine",
    "Notice",
    "Plan",
    "ServerNotFound",
    "Setpoints",
    "Summary",
    "Violation",
    "aio",
    "shipped_machines",
    "slowest_spots",
]
