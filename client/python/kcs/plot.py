"""The picture of a plan."""

import io
import math
import os
from typing import Any, Final, NamedTuple, cast

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from kcs._arrays import FloatArray
from kcs._plan_record import PlanRecord
from kcs.setpoints import Setpoints
from kcs.summary import format_time

__all__ = ["Picture", "Window", "draw", "window"]

_AXES: Final = "XYZ"
_COLOURS: Final = ("tab:red", "tab:green", "tab:blue")
_SHORTEST_PERIOD_S: Final = 1e-5


class Picture(Figure):
    """A figure that notebooks show by itself.

    It is not made by way of pyplot, which would keep every figure until it is told to close it.
    """

    def _repr_png_(self) -> bytes:
        content = io.BytesIO()
        self.savefig(content, format="png")
        return content.getvalue()


class Window(NamedTuple):
    """Which setpoints of a plan make up a picture."""

    period_s: float
    first: int
    last: int


def window(cycle_time_s: float, begin: float, end: float | None, samples: int) -> Window:
    """So many setpoints from begin to end, s, within what the server allows."""
    end = cycle_time_s if end is None else min(end, cycle_time_s)
    if samples < 2:
        raise ValueError(f"samples is {samples}: give 2 at least")
    if not 0 <= begin < end:
        raise ValueError(f"nothing lies between {begin} s and {end} s of the plan's {cycle_time_s:.3f} s")
    period = min(max((end - begin) / samples, _SHORTEST_PERIOD_S), 10.0)
    return Window(period, math.floor(begin / period), math.ceil(end / period))


def draw(plan: PlanRecord, setpoints: Setpoints, file: str | os.PathLike[str] | None = None) -> Picture:
    """The path coloured by speed; velocity, acceleration and jerk against time, each with its limits.

    setpoints: of the plan, with velocity, acceleration and jerk. file: where to save the picture; None: nowhere.
    """
    figure: Any = Picture(figsize=(14, 8), layout="constrained")
    left, right = figure.subfigures(1, 2, width_ratios=(1, 1))
    _draw_path(left.subplots(), setpoints)
    limits = plan.machine
    rows = (
        ("Velocity, mm/s", setpoints.velocity_mm_s, limits.velocity_mm_s),
        ("Acceleration, mm/s²", setpoints.acceleration_mm_s2, limits.acceleration_mm_s2),
        ("Jerk, mm/s³", setpoints.jerk_mm_s3, limits.jerk_mm_s3),
    )
    panels = right.subplots(3, 1, sharex=True)
    for panel, (title, values, limit) in zip(panels, rows, strict=True):
        _draw_against_time(panel, setpoints.time_s, values, limit, title)
    panels[-1].set_xlabel("Time, s")
    panels[0].legend(loc="lower right", bbox_to_anchor=(1, 1), ncol=4, frameon=False, borderaxespad=0)
    figure.suptitle(
        f"{plan.machine.name or 'Plan'}: {format_time(plan.summary.cycle_time_s)} ({plan.summary.cycle_time_s:.3f} s), "
        f"tolerance {plan.tolerance_mm:g} mm"
    )
    if file is not None:
        figure.savefig(file, dpi=150)
    return cast(Picture, figure)


def _draw_path(panel: Any, setpoints: Setpoints) -> None:
    """The path from above: X and Y."""
    points = setpoints.position_mm[:, :2]
    speed = np.linalg.norm(setpoints.velocity_mm_s, axis=1)
    lines = np.stack((points[:-1], points[1:]), axis=1)
    # Rapids take little of the time, and are so fast that all cuts would have one colour beside them.
    fastest = float(np.quantile(speed, 0.98))
    coloured = LineCollection(list(lines), array=(speed[:-1] + speed[1:]) / 2, cmap="viridis", linewidths=1.2)
    coloured.set_clim(0, fastest)
    panel.add_collection(coloured)
    panel.set_aspect("equal", adjustable="box")
    panel.autoscale_view()
    panel.set_title("Path, coloured by speed")
    panel.set_xlabel("X, mm")
    panel.set_ylabel("Y, mm")
    faster = "max" if fastest < speed.max() * 0.99 else "neither"
    panel.figure.colorbar(coloured, ax=panel, label="Speed, mm/s", location="bottom", shrink=0.7, extend=faster)


def _draw_against_time(panel: Any, times: FloatArray, values: FloatArray, limits: Any, title: str) -> None:
    for axis, (name, colour) in enumerate(zip(_AXES, _COLOURS, strict=True)):
        if axis < values.shape[1]:
            panel.plot(times, values[:, axis], color=colour, linewidth=0.8, label=name)
    for axis, limit in enumerate(limits):
        label = "limits" if axis == 0 else None
        for bound in (-limit, limit):
            panel.axhline(bound, color=_COLOURS[axis], linestyle="--", linewidth=0.8, alpha=0.6)
        if label:
            panel.plot([], [], color="grey", linestyle="--", linewidth=0.8, label=label)
    panel.set_ylabel(title)
    panel.margins(x=0)
    panel.grid(alpha=0.3)
