"""Setpoints of a plan."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np

from kcs import _contract
from kcs._arrays import FloatArray, IndexArray, LineArray, Table

__all__ = ["Channel", "Setpoints"]

Channel: TypeAlias = Literal["velocity", "acceleration", "jerk", "path_position", "segment", "line"]

_CHANNELS = _contract.enum_values("Channel")
del _CHANNELS["position"]  # is sent in any case
_PER_AXIS = {
    "position": "position_mm",
    "velocity": "velocity_mm_s",
    "acceleration": "acceleration_mm_s2",
    "jerk": "jerk_mm_s3",
}


@dataclass(frozen=True, repr=False)
class Setpoints:
    """Consecutive setpoints of n instants. Arrays per axis have the shape (n, axes), their columns are contiguous.
    Those of a batch are read-only. A channel that was not asked for raises AttributeError.
    """

    first_index: int
    """Index of the first one: setpoint i belongs to the time i × period."""
    time_s: FloatArray
    """Shape (n,), s; the last setpoint of a plan is the exact end of the path."""
    columns: dict[str, Table]
    """The arrays by the names of their channels: "position", "velocity", …"""

    def __len__(self) -> int:
        return len(self.time_s)

    def __repr__(self) -> str:
        """What a prompt shows: one line, not the arrays."""
        span = f", {self.time_s[0]:.3f} to {self.time_s[-1]:.3f} s" if len(self) else ""
        return f"<{len(self):,} setpoints{span}: {', '.join(self.columns)}>"

    @property
    def position_mm(self) -> FloatArray:
        """Shape (n, axes), mm."""
        return self._column("position")

    @property
    def velocity_mm_s(self) -> FloatArray:
        """Shape (n, axes), mm/s."""
        return self._column("velocity")

    @property
    def acceleration_mm_s2(self) -> FloatArray:
        """Shape (n, axes), mm/s²."""
        return self._column("acceleration")

    @property
    def jerk_mm_s3(self) -> FloatArray:
        """Shape (n, axes), mm/s³; where two phases meet, that of the later one."""
        return self._column("jerk")

    @property
    def path_position_mm(self) -> FloatArray:
        """Shape (n,), mm: how far along the programmed path the tool is."""
        return self._column("path_position")

    @property
    def segment(self) -> IndexArray:
        """Shape (n,): the segment of the path that this place lies on, from 0."""
        return self._column("segment")

    @property
    def line(self) -> LineArray:
        """Shape (n,): the line of the program that this segment comes from, from 1; 0 if not known."""
        return self._column("line")

    def _column(self, channel: str) -> Table:
        if channel not in self.columns:
            raise AttributeError(f"these setpoints carry no {channel}: ask for it with channels=[{channel!r}]")
        return self.columns[channel]


class SetpointRequest:
    """What is wanted of a plan's setpoints, and how far one has come with it."""

    def __init__(
        self,
        plan: str,
        cycle_time_s: float,
        period: float,
        channels: Sequence[Channel],
        first: int,
        last: int | None,
        batch_size: int | None,
    ) -> None:
        for channel in channels:
            if channel not in _CHANNELS:
                raise ValueError(f"there is no channel {channel!r}: use some of {', '.join(_CHANNELS)}")
        self._plan = plan
        self._cycle_time_s = cycle_time_s
        self._period_s = float(period)
        self._channels = list(dict.fromkeys(channels))
        self._next = first
        self._last = last
        self._batch_size = batch_size

    def message(self) -> _contract.Message:
        """Asks for all that has not come yet."""
        return _contract.StreamSetpointsRequest(
            name=self._plan,
            period_s=self._period_s,
            first_index=self._next,
            last_index=self._last,
            batch_size=self._batch_size,
            channels=[_CHANNELS[channel] for channel in self._channels],
        )

    def take(self, batch: _contract.Message) -> Setpoints:
        """The setpoints of the next message."""
        columns = {channel: _column(batch, channel) for channel in ("position", *self._channels)}
        count = len(columns["position"])
        self._next = batch.first_index + count
        times = np.arange(batch.first_index, self._next, dtype=np.float64) * self._period_s
        np.minimum(times, self._cycle_time_s, out=times)
        return Setpoints(batch.first_index, times, columns)


def _column(batch: _contract.Message, channel: str) -> Any:
    if channel == "segment":
        return np.array(batch.segment, dtype=np.uint64)
    if channel == "line":
        return np.array(batch.line, dtype=np.uint32)
    if channel == "path_position":
        return _contract.from_packed(batch.path_position_mm)
    axes = getattr(batch, _PER_AXIS[channel])
    return _contract.from_packed(piece for axis in axes for piece in axis.values).reshape(len(axes), -1).T


def join(parts: list[Setpoints]) -> Setpoints:
    """The setpoints of several messages as one. Empties the parts on the way, so as to need memory for one channel more,
    not for all.
    """
    columns = {}
    for channel in list(parts[0].columns):
        # In the order in which they lie in memory, so that an axis stays contiguous.
        columns[channel] = np.concatenate([part.columns.pop(channel).T for part in parts], axis=-1).T
    return Setpoints(parts[0].first_index, np.concatenate([part.time_s for part in parts]), columns)
