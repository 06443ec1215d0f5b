"""The client for ordinary programs and notebooks; ``kcs.aio`` has one for asyncio."""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import grpc
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
    """Asks a server to plan tool paths.

    May be used by several threads at once; a process that is forked needs a client of its own. ``with kcs.Client() as
    client:`` closes it at the end; otherwise it is closed when nobody uses it any more, or its plans.
    """

    def __init__(self, server: str | Connection | None = None) -> None:
        """server: "HOST:PORT", "unix:/path/of/socket", or a Connection for TLS and tokens. Does not connect yet.

        Without a server, one is started for this client alone, and ends with it: ServerNotFound if there is no kcsd
        (where it is sought: KCS_SERVER, beside the Python program, on the PATH, in the source tree's build/release).
        """
        self._embedded = EmbeddedServer() if server is None else None
        if self._embedded:
            server = self._embedded.address
        self._connection = server if isinstance(server, Connection) else Connection(str(server))
        self._channel = self._connection.open_channel()
        self._health = self._channel.unary_unary("/grpc.health.v1.Health/Check")
        self._create = _contract.method(self._channel, "CreatePlan")
        self._get = _contract.method(self._channel, "GetPlan")
        self._delete = _contract.method(self._channel, "DeletePlan")
        self._setpoints = _contract.method(self._channel, "StreamSetpoints")
        self._corners = _contract.method(self._channel, "DescribeCorners")

    def __enter__(self) -> "Client":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Ends the connection, and the server if it is the client's own. Plans of this client can then ask no more."""
        self._channel.close()
        if self._embedded:
            self._embedded.close()

    def plan(
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
        """Plans a tool path, and waits until the plan is made and verified.

        machine: a Machine, the name of a shipped profile ("router"; see shipped_machines()), or a TOML file of one.
        gcode: the program, RS-274: its text (str or bytes), or a pathlib.Path of its file.
        points: shape (n, axes), mm; the tool starts at the first, and every further one ends a straight segment. Either
            gcode or points.
        tolerance: how far the tool may leave the path at a corner, mm, 0 (stops at every corner) to 1000; with points
            also shape (n,), for the segment that ends at each. Default: 0.01.
        tolerance_kind: what it limits: "contour_error", the largest distance to the path, or "corner_distance", that
            from the corner point to the middle of the smoothed corner.
        strategy: how corners are taken; "auto": the fastest for each.
        feed: mm/s, 1e-6 to 1e6; replaces every programmed feed and the rapid; with points also shape (n,), for the
            segment that ends at each. Default: as programmed; points need it.
        lines: with points, shape (n,): the line of the program that each segment comes from, from 1.
        stops: with points, where the tool stops: index of the point → how long, s.
        start: with gcode, where the tool is at first, mm, one number per axis. Default: the machine's zero.

        The same request gives the same plan, with the same name. Raises Error if the server refuses the request or does
        not answer, ValueError if the arguments do not fit each other, OSError if a file cannot be read.
        """
        requests = plan_requests(machine, gcode, points, tolerance, tolerance_kind, strategy, feed, lines, stops, start)
        try:
            return self._plan(self._answer(self._create, requests, patience=None))
        except Error as failure:
            if isinstance(gcode, Path) and failure.violations:
                raise failure.in_file(gcode) from None
            raise

    def get(self, name: str) -> "Plan":
        """A plan that the server keeps. Raises Error ("NOT_FOUND") if it does not."""
        return self._plan(self._answer(self._get, _contract.GetPlanRequest(name=name), self._connection.patience_s))

    def delete(self, name: str) -> None:
        """Makes the server forget a plan. Raises Error ("NOT_FOUND") if it does not keep it."""
        self._answer(self._delete, _contract.DeletePlanRequest(name=name), self._connection.patience_s)

    def _plan(self, message: _contract.Message) -> "Plan":
        return Plan(**vars(from_message(message)), _client=self)

    @contextmanager
    def _call(self, patience: float | None) -> Iterator[dict[str, Any]]:
        """What every call is made with. Calls that take as long as they need ask first whether somebody is there."""
        metadata = self._connection.metadata()
        try:
            if patience is None:
                self._health(b"", timeout=self._connection.patience_s)
            yield {"metadata": metadata, "timeout": patience}
        except grpc.RpcError as failure:
            raise _status.error_of(failure, self._connection) from None

    def _answer(self, method: Callable[..., Any], request: Any, patience: float | None) -> _contract.Message:
        with self._call(patience) as arguments:
            call = method.future(request, **arguments)  # type: ignore[attr-defined]
            try:
                return call.result()
            finally:
                call.cancel()  # where Ctrl-C ended the waiting; does nothing to a call that has ended

    def _messages(self, method: Callable[..., Any], request: _contract.Message) -> Iterator[_contract.Message]:
        with self._call(patience=None) as arguments:
            call = method(request, **arguments)
            try:
                yield from call
            finally:
                call.cancel()


class Plan(PlanRecord):
    """A plan that a server keeps: its summary is here, setpoints and corners come when they are asked for."""

    def __init__(self, *, _client: Client, **record: Any) -> None:
        super().__init__(**record)
        object.__setattr__(self, "_client", _client)

    _client: Client

    def corners(self) -> Table:
        """How every corner is taken and what it costs, in the order of the path: a structured array.

        Its fields are those of the contract's message Corner: ``line``, ``segment``, ``angle_deg``, ``strategy``
        ("interrupted", "overlapping", …), ``speed_mm_s``, ``time_lost_s``, ``point_mm`` (shape (axes,)), …
        """
        axes = self.machine.axes
        messages = self._client._messages(self._client._corners, _contract.DescribeCornersRequest(name=self.name))
        return corners.whole_table([corners.batch_table(batch.corners, axes) for batch in messages], axes)

    def setpoints(
        self, period: float, channels: Sequence[Channel] = (), *, first: int = 0, last: int | None = None
    ) -> Setpoints:
        """The plan sampled at a fixed period, as arrays. ``setpoint_batches`` gives what would not fit the memory.

        period: time between two setpoints, s, 1e-5 to 10.
        channels: what is wanted beside the position: "velocity", "acceleration", "jerk", "path_position", "segment",
            "line".
        first, last: indices of the first and last setpoint wanted. Default: the whole plan.
        """
        return join(list(self.setpoint_batches(period, channels, first=first, last=last, batch_size=16384)))

    def setpoint_batches(
        self,
        period: float,
        channels: Sequence[Channel] = (),
        *,
        first: int = 0,
        last: int | None = None,
        batch_size: int | None = None,
    ) -> Iterator[Setpoints]:
        """The same piece by piece, as they come from the server, which sends no faster than they are taken.

        batch_size: setpoints in a batch, 1 to 32768. Default: 4096.

        A connection that breaks is taken up again where it broke, with the same bytes; Error if that fails.
        """
        request = SetpointRequest(self.name, self.summary.cycle_time_s, period, channels, first, last, batch_size)
        return self._batches(request)

    def _batches(self, request: SetpointRequest) -> Iterator[Setpoints]:
        while True:
            came = 0
            try:
                for batch in self._client._messages(self._client._setpoints, request.message()):
                    came += 1
                    yield request.take(batch)
                return
            except Error as failure:
                if failure.code not in LOST or came == 0:
                    raise

    def plot(
        self,
        file: str | os.PathLike[str] | None = None,
        *,
        begin: float = 0.0,
        end: float | None = None,
        samples: int = 20_000,
    ) -> "Picture":
        """A picture: the path coloured by speed; velocity, acceleration and jerk against time, with their limits.

        file: where to save it; its ending says the format (.png, .svg, .pdf). None: nowhere.
        begin, end: the part of the cycle to show, s. Default: all of it.
        samples: instants at which the motion is looked at, evenly over that time.
        Needs matplotlib. Returns its Figure, which notebooks show by itself.
        """
        from kcs.plot import draw, window

        period, first, last = window(self.summary.cycle_time_s, begin, end, samples)
        channels: tuple[Channel, ...] = ("velocity", "acceleration", "jerk")
        return draw(self, self.setpoints(period, channels, first=first, last=last), file)
