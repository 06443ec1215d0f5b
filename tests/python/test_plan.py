"""Plans and their summaries."""

from pathlib import Path

import numpy as np
import pytest

import kcs

RIGHT_ANGLE = [[0, 0], [10, 0], [10, 10]]


def test_the_papers_worked_example_comes_out(client: kcs.Client, table: kcs.Machine) -> None:
    plan = client.plan(
        points=RIGHT_ANGLE,
        machine=table,
        feed=100,
        tolerance=0.02,
        tolerance_kind="corner_distance",
        strategy="interrupted",
    )
    [corner] = plan.corners()
    assert corner["strategy"] == "interrupted"
    assert corner["angle_deg"] == pytest.approx(90)
    assert corner["deviation_mm"] == pytest.approx(0.02, rel=1e-3)
    assert corner["speed_mm_s"] > 0
    assert plan.summary.path_length_mm == 20
    assert (plan.summary.start_mm, plan.summary.end_mm) == ((0, 0), (10, 10))
    assert plan.summary.interrupted_count == plan.summary.corner_count == 1


def test_gcode_and_points_of_one_path_give_the_same_motion(client: kcs.Client, table: kcs.Machine, data: Path) -> None:
    from_file = client.plan(gcode=data / "right_angle.nc", machine=table, tolerance=0.02)
    from_points = client.plan(points=RIGHT_ANGLE, machine=table, tolerance=0.02, feed=100)
    assert from_file.summary == from_points.summary


def test_the_program_is_a_file_text_or_bytes(client: kcs.Client, table: kcs.Machine, data: Path) -> None:
    file = data / "zigzag.nc"
    plans = [client.plan(gcode=gcode, machine=table) for gcode in (file, file.read_text(), file.read_bytes())]
    assert len({plan.name for plan in plans}) == 1


def test_a_long_program_and_a_long_path_go_in_pieces(client: kcs.Client, table: kcs.Machine) -> None:
    gcode = "G1 X1 F6000\n" + "( a comment that is of no use to anybody )\n" * 20_000 + "X20\n"
    assert client.plan(gcode=gcode, machine=table).summary.path_length_mm == 20
    points = np.zeros((20_001, 2))
    points[:, 0] = np.arange(20_001) * 0.01
    plan = client.plan(points=points, machine=table, feed=np.full(20_001, 80.0), lines=np.arange(1, 20_002))
    assert plan.summary.path_length_mm == pytest.approx(200)
    assert plan.summary.max_feed_mm_s == pytest.approx(80)


def test_stops_and_tolerances_belong_to_their_points(client: kcs.Client, table: kcs.Machine) -> None:
    points = [[0, 0], [10, 0], [10, 10], [20, 10]]
    plan = client.plan(
        points=points, machine=table, feed=[50] * 4, tolerance=[0.02] * 4, lines=[1, 7, 8, 9], stops={1: 0.5}
    )
    stop, corner = plan.corners()
    assert (stop["strategy"], stop["dwell_s"], stop["line"]) == ("exact_stop", 0.5, 7)
    assert (corner["strategy"] != "exact_stop") and corner["line"] == 8
    assert plan.summary.dwell_time_s == 0.5


def test_a_program_starts_where_it_is_told(client: kcs.Client, table: kcs.Machine) -> None:
    plan = client.plan(gcode="G1 X1 F600\n", machine=table, start=[0.25, 3])
    assert plan.summary.start_mm == (0.25, 3)


def test_notices_of_the_program_come_with_the_plan(client: kcs.Client, table: kcs.Machine) -> None:
    plan = client.plan(gcode="M48\nG1 X1 F600\nM48\n", machine=table)
    assert plan.notices[0].line == 1
    assert "M48" in plan.notices[0].text
    assert plan.notices[0].count == 2


def test_the_plan_says_what_was_used(client: kcs.Client) -> None:
    plan = client.plan(gcode="G1 X1 F600\n", machine="router")
    assert plan.tolerance_mm == 0.01
    assert plan.machine.velocity_mm_s == (200, 200, 100)
    assert plan.machine.rapid_mm_s == 160


def test_the_summary_reads_well(circle: kcs.Plan) -> None:
    assert str(circle.summary).splitlines()[0].startswith("Cycle time          0:00:00   (0.")


def test_a_plan_is_kept_until_it_is_deleted(client: kcs.Client, table: kcs.Machine) -> None:
    plan = client.plan(points=[[0, 0], [1.5, 0]], machine=table, feed=10)
    assert client.get(plan.name).summary == plan.summary
    client.delete(plan.name)
    with pytest.raises(kcs.Error) as failure:
        client.get(plan.name)
    assert failure.value.code == "NOT_FOUND"


def test_one_client_serves_many_threads(client: kcs.Client, table: kcs.Machine) -> None:
    from concurrent.futures import ThreadPoolExecutor

    def cycle_time(length: int) -> float:
        plan = client.plan(points=[[0, 0], [length, 0]], machine=table, feed=50)
        return float(plan.setpoints(0.01).time_s[-1])

    with ThreadPoolExecutor(8) as pool:
        times = list(pool.map(cycle_time, range(1, 33)))
    assert times == sorted(times)
    assert times[-1] > times[0]
