"""From a tool path and its options to the messages that ask for its plan."""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from kcs import _contract
from kcs.machine import Machine, find_machine, to_message

ToleranceKind: TypeAlias = Literal["contour_error", "corner_distance"]
Strategy: TypeAlias = Literal["auto", "interrupted", "uninterrupted", "blended", "exact_stop"]
AnyMachine: TypeAlias = Machine | str | os.PathLike[str]
Gcode: TypeAlias = str | bytes | Path

# Small enough to keep memory low and to stay far below gRPC's largest message of 4 MiB.
_BYTES_PER_MESSAGE = 1 << 18
_POINTS_PER_MESSAGE = 8192

_TOLERANCE_KINDS = _contract.enum_values("ToleranceKind")
_STRATEGIES = _contract.enum_values("CornerStrategy")


def plan_requests(
    machine: AnyMachine,
    gcode: Gcode | None,
    points: npt.ArrayLike | None,
    tolerance: npt.ArrayLike | None,
    tolerance_kind: ToleranceKind,
    strategy: Strategy,
    feed: npt.ArrayLike | None,
    lines: npt.ArrayLike | None,
    stops: Mapping[int, float] | None,
    start: npt.ArrayLike | None,
) -> Iterator[_contract.Message]:
    """All that is not right with the arguments is told here, before the first message is asked for."""
    if (gcode is None) == (points is None):
        raise ValueError("give either gcode or points")
    found = find_machine(machine)
    options = _contract.PlanOptions(
        machine=to_message(found),
        tolerance_kind=_number(_TOLERANCE_KINDS, "tolerance_kind", tolerance_kind),
        strategy=_number(_STRATEGIES, "strategy", strategy),
        start_mm=[] if start is None else _contract.to_packed(start),
    )
    # One number holds for the whole path, and goes into the options; several belong to the points.
    if tolerance is not None and np.ndim(tolerance) == 0:
        options.tolerance_mm = float(tolerance)  # type: ignore[arg-type]
        tolerance = None
    if feed is not None and np.ndim(feed) == 0:
        options.feed_mm_s = float(feed)  # type: ignore[arg-type]
        feed = None
    if points is not None:
        pieces = _path_pieces(found.axes, points, feed, tolerance, lines, stops or {})
    elif any(value is not None for value in (feed, tolerance, lines, stops)):
        raise ValueError(
            "with gcode, feed and tolerance are single numbers, and lines and stops are those of the program"
        )
    else:
        pieces = _gcode_pieces(_program(gcode))
    return _all_messages(options, pieces)


def _all_messages(options: Any, pieces: Iterator[dict[str, Any]]) -> Iterator[_contract.Message]:
    yield _contract.CreatePlanRequest(options=options)
    for piece in pieces:
        yield _contract.CreatePlanRequest(**piece)


def _number(values: Mapping[str, int], name: str, value: str) -> int:
    if value not in values:
        raise ValueError(f"{name} is {value!r}: use one of {', '.join(values)}")
    return values[value]


def _program(gcode: Any) -> bytes:
    if isinstance(gcode, Path):
        return gcode.read_bytes()
    if isinstance(gcode, bytes):
        return gcode
    if "\n" not in gcode and os.path.isfile(gcode):
        raise ValueError(f"{gcode!r} is the name of a file, not a program: give gcode=pathlib.Path({gcode!r})")
    return str(gcode).encode()


def _gcode_pieces(program: bytes) -> Iterator[dict[str, Any]]:
    for begin in range(0, len(program), _BYTES_PER_MESSAGE):
        yield {"gcode": program[begin : begin + _BYTES_PER_MESSAGE]}


def _path_pieces(
    axes: int, points: Any, feed: Any, tolerance: Any, lines: Any, stops: Mapping[int, float]
) -> Iterator[dict[str, Any]]:
    path = np.asarray(points, dtype=np.float64)
    if path.ndim != 2 or path.shape[1] != axes:
        raise ValueError(
            f"points have the shape {path.shape}: give one row per point, of {axes} numbers in mm, as the machine has "
            f"{axes} axes"
        )
    count = len(path)
    columns = {
        "feed_mm_s": ("feed", feed, np.float64),
        "tolerance_mm": ("tolerance", tolerance, np.float64),
        "line": ("lines", lines, np.uint32),
    }
    arrays = {
        field: _one_per_point(name, values, kind, count)
        for field, (name, values, kind) in columns.items()
        if values is not None
    }
    for point in stops:
        if not 0 <= point < count:
            raise ValueError(f"stops names point {point}, but the path has {count} points, counted from 0")

    def pieces() -> Iterator[dict[str, Any]]:
        for begin in range(0, count, _POINTS_PER_MESSAGE):
            end = begin + _POINTS_PER_MESSAGE
            chunk = _contract.PathChunk(points_mm=_contract.to_packed(path[begin:end]))
            for field, values in arrays.items():
                part = values[begin:end]
                getattr(chunk, field).extend(part.tolist() if field == "line" else _contract.to_packed(part))
            for point in sorted(stops):
                if begin <= point < end:
                    chunk.stops.add(point=point - begin, dwell_s=stops[point])
            yield {"path": chunk}

    return pieces()


def _one_per_point(name: str, values: Any, kind: Any, count: int) -> npt.NDArray[Any]:
    array = np.asarray(values, dtype=kind)
    if array.shape != (count,):
        raise ValueError(f"{name} has the shape {array.shape}: give one number per point, which are {count}")
    return array
