"""The picture of a plan."""

import asyncio
from pathlib import Path

import numpy as np
import pytest

import kcs
import kcs.aio

pytest.importorskip("matplotlib", reason="matplotlib is not installed")


def test_it_shows_path_velocity_acceleration_and_jerk_with_limits(circle: kcs.Plan) -> None:
    figure = circle.plot(samples=1000)
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert {"Y, mm", "Velocity, mm/s", "Acceleration, mm/s²", "Jerk, mm/s³"} <= set(labels)
    velocity = figure.axes[labels.index("Velocity, mm/s")]
    curve = next(line for line in velocity.get_lines() if line.get_label() == "X")
    assert np.max(np.abs(curve.get_ydata())) == pytest.approx(circle.summary.max_velocity_mm_s[0], rel=0.05)
    levels = {line.get_ydata()[0] for line in velocity.get_lines() if len(line.get_ydata()) == 2}
    assert {500, -500} <= levels


def test_it_may_show_a_part_of_the_cycle(circle: kcs.Plan) -> None:
    figure = circle.plot(begin=0.1, end=0.2)
    labels = [axes.get_ylabel() for axes in figure.axes]
    times = figure.axes[labels.index("Jerk, mm/s³")].get_lines()[0].get_xdata()
    assert times[0] == pytest.approx(0.1, abs=1e-4)
    assert times[-1] == pytest.approx(0.2, abs=1e-4)
    with pytest.raises(ValueError, match="nothing lies between"):
        circle.plot(begin=1000)


@pytest.mark.parametrize(("ending", "begins_with"), [("png", b"\x89PNG"), ("svg", b"<?xml")])
def test_it_is_saved_in_the_format_of_its_name(
    circle: kcs.Plan, tmp_path: Path, ending: str, begins_with: bytes
) -> None:
    file = tmp_path / f"circle.{ending}"
    circle.plot(file, samples=200)
    assert file.read_bytes().startswith(begins_with)


def test_notebooks_can_show_it(circle: kcs.Plan) -> None:
    assert circle.plot(samples=200)._repr_png_().startswith(b"\x89PNG")


def test_asyncio_draws_it_too(client: kcs.Client, circle: kcs.Plan, tmp_path: Path) -> None:
    async def draw() -> None:
        async with kcs.aio.Client(client._connection.address) as own:
            await (await own.get(circle.name)).plot(tmp_path / "circle.png", samples=200)

    asyncio.run(draw())
    assert (tmp_path / "circle.png").stat().st_size > 1000
