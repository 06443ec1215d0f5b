"""Setpoints as arrays."""

import pathlib

import numpy as np
import pytest

import kcs

ALL = ("velocity", "acceleration", "jerk", "path_position", "segment", "line")


def test_they_start_and_end_at_rest_on_the_ends_of_the_path(circle: kcs.Plan) -> None:
    setpoints = circle.setpoints(0.001, ["velocity"])
    assert setpoints.position_mm.shape == (len(setpoints), 2)
    assert setpoints.position_mm[0] == pytest.approx(circle.summary.start_mm)
    assert setpoints.position_mm[-1] == pytest.approx(circle.summary.end_mm)
    assert setpoints.velocity_mm_s[[0, -1]] == pytest.approx(0, abs=1e-9)
    assert setpoints.time_s[-1] == circle.summary.cycle_time_s
    assert np.diff(setpoints.time_s)[:-1] == pytest.approx(0.001)


def test_they_keep_the_limits_and_fit_each_other(circle: kcs.Plan) -> None:
    setpoints = circle.setpoints(1e-4, ALL)
    machine = circle.machine
    assert (abs(setpoints.velocity_mm_s) <= np.multiply(machine.velocity_mm_s, 1 + 1e-6)).all()
    assert (abs(setpoints.acceleration_mm_s2) <= np.multiply(machine.acceleration_mm_s2, 1 + 1e-6)).all()
    assert (abs(setpoints.jerk_mm_s3) <= np.multiply(machine.jerk_mm_s3, 1 + 1e-6)).all()
    moved = np.diff(setpoints.position_mm, axis=0)
    expected = (setpoints.velocity_mm_s[1:] + setpoints.velocity_mm_s[:-1]) / 2 * np.diff(setpoints.time_s)[:, None]
    # Between two setpoints the velocity is nearly straight: not by more than jerk × period³ / 12.
    assert moved == pytest.approx(expected, abs=2e-8)
    assert (np.diff(setpoints.path_position_mm) >= 0).all()
    assert setpoints.path_position_mm[-1] == pytest.approx(circle.summary.path_length_mm)
    assert setpoints.segment[-1] == circle.summary.segment_count - 1


def test_lines_are_those_of_the_program(client: kcs.Client, table: kcs.Machine) -> None:
    loop = "F3000\n#1=0\no1 while [#1 LT 2]\nG1 X10\nX0\n#1=[#1+1]\no1 endwhile\nG1 Y5\n"
    setpoints = client.plan(gcode=loop, machine=table).setpoints(0.001, ["line", "segment"])
    assert setpoints.line.dtype == np.uint32
    line_of_segment = np.array([4, 5, 4, 5, 8])
    assert np.array_equal(setpoints.line, line_of_segment[setpoints.segment])
    assert set(setpoints.line) == {4, 5, 8}


def test_points_have_the_lines_that_were_given(client: kcs.Client, table: kcs.Machine, circle: kcs.Plan) -> None:
    plan = client.plan(points=[[0, 0], [5, 0], [5, 5]], machine=table, feed=100, lines=[1, 30, 20])
    line = plan.setpoints(0.001, ["line"]).line
    assert line[0] == 30 and line[-1] == 20 and set(line) == {20, 30}
    assert not circle.setpoints(0.001, ["line"]).line.any()


def test_they_go_into_hdf5_and_come_back(circle: kcs.Plan, tmp_path: pathlib.Path) -> None:
    h5py = pytest.importorskip("h5py", reason="python3-h5py is not installed")
    setpoints = circle.setpoints(0.001, ["velocity", "segment"])
    names = ("time_s", "position_mm", "velocity_mm_s", "segment")
    with h5py.File(tmp_path / "circle.h5", "w") as file:
        for name in names:
            file[name] = getattr(setpoints, name)
    with h5py.File(tmp_path / "circle.h5") as file:
        for name in names:
            assert np.array_equal(file[name], getattr(setpoints, name)), name


def test_batches_are_the_same_in_pieces(circle: kcs.Plan) -> None:
    whole = circle.setpoints(0.001, ALL)
    batches = list(circle.setpoint_batches(0.001, ALL, batch_size=100))
    assert [len(batch) for batch in batches[:-1]] == [100] * (len(batches) - 1)
    assert [batch.first_index for batch in batches] == list(range(0, len(whole), 100))
    names = ("position_mm", "velocity_mm_s", "acceleration_mm_s2", "jerk_mm_s3", "path_position_mm", "segment", "line")
    for name in names:
        assert np.array_equal(np.concatenate([getattr(batch, name) for batch in batches]), getattr(whole, name))
    assert np.array_equal(np.concatenate([batch.time_s for batch in batches]), whole.time_s)


def test_a_part_of_them_has_its_place_in_the_whole(circle: kcs.Plan) -> None:
    whole = circle.setpoints(0.001)
    part = circle.setpoints(0.001, first=20, last=29)
    assert part.first_index == 20
    assert np.array_equal(part.position_mm, whole.position_mm[20:30])
    assert np.array_equal(part.time_s, whole.time_s[20:30])


def test_an_axis_lies_in_one_piece(circle: kcs.Plan) -> None:
    assert circle.setpoints(0.001).position_mm[:, 0].flags.c_contiguous


def test_a_channel_that_was_not_asked_for_says_so(circle: kcs.Plan) -> None:
    with pytest.raises(AttributeError, match=r"channels=\['jerk'\]"):
        circle.setpoints(0.001).jerk_mm_s3


def test_an_unknown_channel_is_refused_with_those_that_there_are(circle: kcs.Plan) -> None:
    with pytest.raises(ValueError, match="velocity, acceleration, jerk, path_position, segment, line"):
        circle.setpoints(0.001, ["speed"])  # type: ignore[list-item]


def test_a_period_out_of_range_is_refused_by_the_server(circle: kcs.Plan) -> None:
    with pytest.raises(kcs.Error) as failure:
        circle.setpoints(0)
    assert failure.value.violations[0].field == "period_s"


def test_a_prompt_shows_them_and_their_plan_in_a_line_each(circle: kcs.Plan) -> None:
    assert repr(circle) == f"<Plan '{circle.name}': {circle.summary.cycle_time_s:.3f} s on table>"
    setpoints = circle.setpoints(0.001, ["jerk"])
    assert repr(setpoints) == f"<{len(setpoints):,} setpoints, 0.000 to {setpoints.time_s[-1]:.3f} s: position, jerk>"
