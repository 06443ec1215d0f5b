"""The client for asyncio. What the methods take and give is said in ``kcs.Client`` and ``kcs.Plan``: here one awaits it.

async with kcs.aio.Client() as client:
    plan = await client.plan(gcode=pathlib.Path("part.nc"), machine="router")
    async for batch in plan.setpoint_batches(0.001):
        …
"""

import asyncio
import os
from collections.abc import AsyncIterator, Mapping, Sequence
from contextlib import asynccontextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import grpc
import grpc.aio
import numpy.typing as npt

from kcs import _contract, _status, corners
from kcs._arrays import Table
from kcs._embedded import EmbeddedServer
from kcs._plan_record import PlanRecord, from_message
from kcs._requests import AnyMachine, Gcode, Strategy, ToleranceKind, plan_requests
from kcs.connection import LOST, Connection
from kcs.errors import Error
from kcs.setpoints import Channel, SetpointRequest, Setpoints, join

if TYPE_CHECKING:
    from kcs.plot import Picture

__all__ = ["Client", "Plan"]


class Client:
    """Asks a server to plan tool paths. Belongs to the event loop in which it is used first; many tasks may share it.

    A task that is cancelled cancels its call on the server, too.
    """

    def __init__(self, server: str | Connection | None = None) -> None:
        """server: as in kcs.Client. The first call connects; without a server, it starts one for this client alone."""
        self._server = Connection(server) if isinstance(server, str) else server
        self._embedded: EmbeddedServer | None = None
        self._channel: Any = None
        self._starting = asyncio.Lock()

    async def __aenter__(self) -> "Client":
        await self._open()
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    async def close(self) -> None:
        """Ends the connection, and the server if it is the client's own."""
        if self._channel:
            await self._channel.close()
        if self._embedded:
            await asyncio.to_thread(self._embedded.close)

    async def plan(
        self,
        *,
        machine: AnyMachine,
        gcode: Gcode | None = None,
        points: npt.ArrayLike | None = None,
        tolerance: npt.ArrayLike | None = None,
        tolerance_kind: ToleranceKind = "contour_error",
        strategy: Strategy = "auto",
        feed: npt.ArrayLike | None = None,
        lines: npt.ArrayLike | None = None,
        stops: Mapping[int, float] | None = None,
        start: npt.ArrayLike | None = None,
    ) -> "Plan":
        """Plans a tool path, and waits until the plan is made and verified. See kcs.Client.plan."""
        requests = plan_requests(machine, gcode, points, tolerance, tolerance_kind, strategy, feed, lines, stops, start)
        try:
            return self._plan(await self._answer("CreatePlan", requests, quick=False))
        except Error as failure:
            if isinstance(gcode, Path) and failure.violations:
                raise failure.in_file(gcode) from None
            raise

    async def get(self, name: str) -> "Plan":
        """A plan that the server keeps. Raises Error ("NOT_FOUND") if it does not."""
        return self._plan(await self._answer("GetPlan", _contract.GetPlanRequest(name=name)))

    async def delete(self, name: str) -> None:
        """Makes the server forget a plan. Raises Error ("NOT_FOUND") if it does not keep it."""
        await self._answer("DeletePlan", _contract.DeletePlanRequest(name=name))

    def _plan(self, message: _contract.Message) -> "Plan":
        return Plan(**vars(from_message(message)), _client=self)

    async def _open(self) -> Connection:
        async with self._starting:
            if self._server is None:
                self._embedded = await asyncio.to_thread(EmbeddedServer)
                self._server = Connection(self._embedded.address)
            if self._channel is None:
                self._channel = self._server.open_channel(grpc.aio)
            return self._server

    @asynccontextmanager
    async def _call(self, quick: bool) -> AsyncIterator[dict[str, Any]]:
        """What every call is made with. Calls that take as long as they need ask first whether somebody is there."""
        connection = await self._open()
        metadata = connection.metadata()
        try:
            if not quick:
                await self._channel.unary_unary("/grpc.health.v1.Health/Check")(b"", timeout=connection.patience_s)
            yield {"metadata": metadata, "timeout": connection.patience_s if quick else None}
        except grpc.RpcError as failure:
            raise _status.error_of(failure, connection) from None

    async def _answer(self, method: str, request: Any, quick: bool = True) -> _contract.Message:
        async with self._call(quick) as arguments:
            return await _contract.method(self._channel, method)(request, **arguments)

    async def _messages(self, method: str, request: _contract.Message) -> AsyncIterator[_contract.Message]:
        async with self._call(quick=False) as arguments:
            call = _contract.method(self._channel, method)(request, **arguments)
            try:
                async for message in call:
                    yield message
            finally:
                call.cancel()


class Plan(PlanRecord):
    """A plan that a server keeps: its summary is here, setpoints and corners come when they are asked for."""

    def __init__(self, *, _client: Client, **record: Any) -> None:
        super().__init__(**record)
        object.__setattr__(self, "_client", _client)

    _client: Client

    async def corners(self) -> Table:
        """How every corner is taken and what it costs. See kcs.Plan.corners."""
        axes = self.machine.axes
        messages = self._client._messages("DescribeCorners", _contract.DescribeCornersRequest(name=self.name))
        return corners.whole_table([corners.batch_table(batch.corners, axes) async for batch in messages], axes)

    async def setpoints(
        self, period: float, channels: Sequence[Channel] = (), *, first: int = 0, last: int | None = None
    ) -> Setpoints:
        """The plan sampled at a fixed period, as arrays. See kcs.Plan.setpoints."""
        batches = self.setpoint_batches(period, channels, first=first, last=last, batch_size=16384)
        return join([batch async for batch in batches])

    async def setpoint_batches(
        self,
        period: float,
        channels: Sequence[Channel] = (),
        *,
        first: int = 0,
        last: int | None = None,
        batch_size: int | None = None,
    ) -> AsyncIterator[Setpoints]:
        """The same piece by piece, as they come from the server. See kcs.Plan.setpoint_batches."""
        request = SetpointRequest(self.name, self.summary.cycle_time_s, period, channels, first, last, batch_size)
        while True:
            came = 0
            try:
                async for batch in self._client._messages("StreamSetpoints", request.message()):
                    came += 1
                    yield request.take(batch)
                return
            except Error as failure:
                if failure.code not in LOST or came == 0:
                    raise

    async def plot(
        self,
        file: str | os.PathLike[str] | None = None,
        *,
        begin: float = 0.0,
        end: float | None = None,
        samples: int = 20_000,
    ) -> "Picture":
        """A picture of path, velocity, acceleration and jerk. See kcs.Plan.plot."""
        from kcs.plot import draw, window

        period, first, last = window(self.summary.cycle_time_s, begin, end, samples)
        channels: tuple[Channel, ...] = ("velocity", "acceleration", "jerk")
        return draw(self, await self.setpoints(period, channels, first=first, last=last), file)
