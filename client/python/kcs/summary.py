"""What a plan amounts to, and what the reader of its program noticed."""

from dataclasses import dataclass, fields
from typing import Any

from kcs import _contract

__all__ = ["Notice", "Summary"]


@dataclass(frozen=True)
class Summary:
    """What a plan amounts to. The ``max_*`` figures are found by the server's verifier, exactly, not by sampling."""

    cycle_time_s: float
    """From the first point to the last, dwells included, s."""
    path_length_mm: float
    """Length of the programmed path, mm."""
    segment_count: int
    """Straight segments of the path, arcs counted as their chords."""
    corner_count: int
    """Joints at which the direction changes or the tool stops. The next five add up to it."""
    interrupted_count: int
    uninterrupted_count: int
    exact_stop_count: int
    blended_count: int
    overlapping_count: int
    time_lost_at_corners_s: float
    """What the corners cost, s."""
    dwell_time_s: float
    """Programmed dwells, s."""
    time_at_feed_s: float
    """Time during which the tool moves at the programmed feed, s."""
    max_contour_error_mm: float
    """Largest distance from the motion to the programmed path of straight segments, mm."""
    max_chord_error_mm: float
    """Largest distance between a programmed arc and its chords, mm; 0 without arcs."""
    max_feed_mm_s: float
    """Largest speed along the path, mm/s."""
    max_velocity_mm_s: tuple[float, ...]
    """Largest magnitude of each axis' velocity, mm/s."""
    max_acceleration_mm_s2: tuple[float, ...]
    """Largest magnitude of each axis' acceleration, mm/s²."""
    max_jerk_mm_s3: tuple[float, ...]
    """Largest magnitude of each axis' jerk, mm/s³."""
    phase_count: int
    """Constant-jerk phases of the motion."""
    start_mm: tuple[float, ...]
    """First point of the path, mm, one number per axis."""
    end_mm: tuple[float, ...]
    """Last point of the path, mm, one number per axis."""

    def __str__(self) -> str:
        """The figures that one looks at first, one a line."""
        share = 100 / self.cycle_time_s if self.cycle_time_s > 0 else 0.0
        return "\n".join(
            (
                f"Cycle time          {format_time(self.cycle_time_s)}   ({self.cycle_time_s:.3f} s)",
                f"Path                {self.path_length_mm:.3f} mm in {self.segment_count:,} segments",
                f"Corners             {self.corner_count:,}, of them {self.exact_stop_count:,} exact "
                f"stop{'' if self.exact_stop_count == 1 else 's'}",
                f"Lost at corners     {self.time_lost_at_corners_s:.3f} s, "
                f"{self.time_lost_at_corners_s * share:.1f} % of the cycle time",
                f"At feed             {self.time_at_feed_s:.3f} s, {self.time_at_feed_s * share:.1f} % of the cycle time",
                f"Highest feed        {self.max_feed_mm_s:.2f} mm/s ({self.max_feed_mm_s * 60:.0f} mm/min)",
                f"Contour error       {self.max_contour_error_mm:.5f} mm at most",
            )
        )


@dataclass(frozen=True)
class Notice:
    """Something about the program that its author should know."""

    line: int
    """Where it came up first, from 1."""
    text: str
    """What was noticed, and what kcs did about it."""
    count: int
    """How often it came up."""

    def __str__(self) -> str:
        return f"line {self.line}: {self.text}" + (f" (×{self.count})" if self.count > 1 else "")


def format_time(seconds: float) -> str:
    """Hours, minutes and seconds: "0:10:34"."""
    whole = round(seconds)
    return f"{whole // 3600}:{whole // 60 % 60:02}:{whole % 60:02}"


def from_message(message: _contract.Message) -> Summary:
    return Summary(**{field.name: _value(getattr(message, field.name)) for field in fields(Summary)})


def _value(value: Any) -> Any:
    return value if isinstance(value, int | float) else tuple(_contract.from_packed(value).tolist())
