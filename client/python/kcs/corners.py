"""Corners of a plan as a table, and where a program is slow."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from kcs import _contract
from kcs._arrays import Table

__all__ = ["slowest_spots"]

# As the contract (message Corner) says them. Of all but strategy and point_mm the column is the field.
_COLUMNS = (
    ("segment", np.uint64),
    ("line", np.uint32),
    ("angle_deg", np.float64),
    ("strategy", "U13"),
    ("speed_mm_s", np.float64),
    ("boundary_acceleration_mm_s2", np.float64),
    ("duration_s", np.float64),
    ("deviation_mm", np.float64),
    ("time_lost_s", np.float64),
    ("corner_distance_mm", np.float64),
    ("contour_error_mm", np.float64),
    ("dwell_s", np.float64),
)
_STRATEGY_NAMES = {number: name for name, number in _contract.enum_values("CornerStrategy").items()}


def _kind(axes: int) -> Any:
    return np.dtype([*_COLUMNS, ("point_mm", np.float64, (axes,))])


def batch_table(corners: Sequence[_contract.Message], axes: int) -> Table:
    """The corners of one message."""
    table = np.empty(len(corners), dtype=_kind(axes))
    for name, _ in _COLUMNS:
        if name == "strategy":
            table[name] = [_STRATEGY_NAMES[corner.strategy] for corner in corners]
        else:
            table[name] = [getattr(corner, name) for corner in corners]
    points = (number for corner in corners for number in corner.point_mm)
    table["point_mm"] = _contract.from_packed(points).reshape(len(corners), axes)
    return table


def whole_table(batches: Sequence[Table], axes: int) -> Table:
    return np.concatenate(batches) if batches else np.empty(0, dtype=_kind(axes))


def slowest_spots(corners: Table, count: int = 10) -> Table:
    """Where a program loses time: the ``count`` worst spots, the worst first; those that lose none are left out.

    A spot is what one line of the program makes of corners one after the other: a single one, or those of an arc's
    chords; without line numbers each corner is a spot. A structured array with ``line``, ``point_mm`` (of the corner
    that costs most), ``corners`` (how many), ``largest_angle_deg``, ``lowest_speed_mm_s`` and ``time_lost_s``.

    corners: what ``plan.corners()`` returns, or a part of it.
    """
    lines = corners["line"]
    begins = np.flatnonzero(np.r_[True, (lines[1:] != lines[:-1]) | (lines[1:] == 0)][: len(lines)])
    ends = np.r_[begins[1:], len(lines)]
    kind = [
        ("line", np.uint32),
        ("point_mm", np.float64, corners["point_mm"].shape[1:]),
        ("corners", np.uint32),
        ("largest_angle_deg", np.float64),
        ("lowest_speed_mm_s", np.float64),
        ("time_lost_s", np.float64),
    ]
    spots = np.empty(len(begins), dtype=kind)
    if not len(begins):
        return spots
    spots["line"] = lines[begins]
    spots["corners"] = ends - begins
    spots["largest_angle_deg"] = np.maximum.reduceat(corners["angle_deg"], begins)
    spots["lowest_speed_mm_s"] = np.minimum.reduceat(corners["speed_mm_s"], begins)
    spots["time_lost_s"] = np.add.reduceat(corners["time_lost_s"], begins)
    worst_first = np.argsort(-spots["time_lost_s"], kind="stable")[: max(count, 0)]
    for spot in worst_first:
        costliest = begins[spot] + np.argmax(corners["time_lost_s"][begins[spot] : ends[spot]])
        spots["point_mm"][spot] = corners["point_mm"][costliest]
    worst: Table = spots[worst_first]
    return worst[worst["time_lost_s"] > 0]
