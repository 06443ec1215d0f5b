"""The client for asyncio."""

import asyncio
from collections.abc import Awaitable, Callable
from pathlib import Path

import numpy as np
import pytest

import kcs


def run(test: Callable[[kcs.aio.Client], Awaitable[None]], server: str | None = None) -> None:
    async def with_client() -> None:
        async with kcs.aio.Client(server) as client:
            await test(client)

    asyncio.run(with_client())


def test_it_gives_what_the_other_client_gives(client: kcs.Client, data: Path) -> None:
    expected = client.plan(gcode=data / "zigzag.nc", machine="router", tolerance=0.05)

    async def test(own: kcs.aio.Client) -> None:
        plan = await own.plan(gcode=data / "zigzag.nc", machine="router", tolerance=0.05)
        assert (plan.name, plan.summary) == (expected.name, expected.summary)
        assert np.array_equal(await plan.corners(), expected.corners())
        setpoints = await plan.setpoints(0.001, ["jerk"])
        assert np.array_equal(setpoints.jerk_mm_s3, expected.setpoints(0.001, ["jerk"]).jerk_mm_s3)
        assert (await own.get(plan.name)).summary == plan.summary
        await own.delete(plan.name)

    run(test)


def test_many_plans_are_made_at_the_same_time(client: kcs.Client, table: kcs.Machine) -> None:
    async def test(own: kcs.aio.Client) -> None:
        plans = await asyncio.gather(
            *(own.plan(points=[[0, 0], [length, 0]], machine=table, feed=50) for length in range(1, 21))
        )
        assert [plan.summary.path_length_mm for plan in plans] == list(range(1, 21))

    run(test, client._connection.address)


def test_batches_may_be_left_before_their_end(client: kcs.Client, table: kcs.Machine) -> None:
    async def test(own: kcs.aio.Client) -> None:
        plan = await own.plan(points=[[0, 0], [100, 0]], machine=table, feed=50)
        async for batch in plan.setpoint_batches(1e-5, batch_size=10):
            assert len(batch) == 10
            break
        assert len(await plan.setpoints(0.001)) > 2000

    run(test, client._connection.address)


def test_a_task_that_is_cancelled_leaves_the_client_in_order(client: kcs.Client, table: kcs.Machine) -> None:
    angle = np.linspace(0, 600, 200_000)
    points = 50 * np.column_stack((np.cos(7 * angle), np.sin(5 * angle)))  # takes seconds to plan

    async def test(own: kcs.aio.Client) -> None:
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(own.plan(points=points, machine=table, feed=100), timeout=0.5)
        assert (await own.plan(points=[[0, 0], [1, 0]], machine=table, feed=50)).summary.path_length_mm == 1

    run(test, client._connection.address)


def test_errors_are_the_same(client: kcs.Client, tmp_path: Path) -> None:
    file = tmp_path / "part.nc"
    file.write_text("G1 X[1/0]\n")

    async def test(own: kcs.aio.Client) -> None:
        with pytest.raises(kcs.Error) as failure:
            await own.plan(gcode=file, machine="router")
        assert failure.value.violations[0].place == f"{file}:1:7"
        with pytest.raises(kcs.Error) as failure:
            await own.get("plans/" + "0" * 64)
        assert failure.value.code == "NOT_FOUND"

    run(test, client._connection.address)


def test_the_server_of_its_own_ends_with_it() -> None:
    async def folder() -> Path:
        async with kcs.aio.Client() as client:
            assert client._server is not None
            return Path(client._server.address.removeprefix("unix:")).parent

    assert not asyncio.run(folder()).exists()
