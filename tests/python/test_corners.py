"""The table of corners, and the spots where a program is slow."""

from pathlib import Path

import numpy as np
import pytest

import kcs


def test_there_is_a_row_for_every_corner(client: kcs.Client, data: Path) -> None:
    plan = client.plan(gcode=data / "zigzag.nc", machine="router", tolerance=0.05)
    corners = plan.corners()
    assert len(corners) == plan.summary.corner_count == 6
    assert corners["point_mm"].shape == (6, 3)
    assert (np.diff(corners["line"].astype(int)) > 0).all()
    assert ((corners["angle_deg"] > 0) & (corners["angle_deg"] <= 180)).all()
    assert corners["time_lost_s"].sum() == pytest.approx(plan.summary.time_lost_at_corners_s)
    assert set(corners["strategy"]) <= {"interrupted", "uninterrupted", "blended", "overlapping", "exact_stop"}


def test_thousands_come_in_the_order_of_the_path(circle: kcs.Plan) -> None:
    corners = circle.corners()
    assert len(corners) == circle.summary.corner_count == 187
    assert (np.diff(corners["segment"].astype(int)) == 1).all()
    assert np.linalg.norm(corners["point_mm"], axis=1) == pytest.approx(3)


def test_a_straight_line_has_an_empty_table(client: kcs.Client, table: kcs.Machine) -> None:
    corners = client.plan(points=[[0, 0], [1, 0]], machine=table, feed=10).corners()
    assert len(corners) == 0
    assert len(kcs.slowest_spots(corners)) == 0


def test_the_slowest_spot_is_the_stop_at_the_sharpest_corner(client: kcs.Client, table: kcs.Machine) -> None:
    points = [[0, 0], [20, 0], [40, 1], [20, 2], [0, 20]]
    plan = client.plan(points=points, machine=table, feed=100, lines=[1, 2, 3, 4, 5], stops={2: 0})
    spots = kcs.slowest_spots(plan.corners(), 2)
    assert len(spots) == 2
    assert spots[0]["line"] == 3
    assert spots[0]["point_mm"].tolist() == [40, 1]
    assert spots[0]["lowest_speed_mm_s"] == 0
    assert spots[0]["time_lost_s"] > spots[1]["time_lost_s"] > 0


def test_the_corners_of_one_line_are_one_spot(client: kcs.Client, table: kcs.Machine) -> None:
    plan = client.plan(gcode="G64 P0.01\nG1 X10 F6000\nY10\nG2 X13 Y13 I3 J0\nG1 X30\n", machine=table)
    corners = plan.corners()
    spots = kcs.slowest_spots(corners)
    assert spots["time_lost_s"].sum() == pytest.approx(corners["time_lost_s"].sum())
    [arc] = spots[spots["line"] == 4]
    assert arc["corners"] == (corners["line"] == 4).sum() > 1
