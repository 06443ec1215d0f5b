"""Machines and their limits."""

import os
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

from kcs import _contract

__all__ = ["Machine", "shipped_machines"]


@dataclass(frozen=True)
class Machine:
    """A machine's axes and their limits, which hold for each axis by itself, in the order X, Y, Z: two or three.

    The server checks the ranges, and refuses what is outside them with an Error that names the field.
    """

    velocity_mm_s: Sequence[float]
    """Largest speed of each axis, mm/s, 1e-3 to 1e6."""

    acceleration_mm_s2: Sequence[float]
    """Largest acceleration of each axis, mm/s², 1e-3 to 1e9."""

    jerk_mm_s3: Sequence[float]
    """Largest jerk of each axis, mm/s³, 1e-3 to 1e12."""

    rapid_mm_s: float | None = None
    """Path speed of rapid moves (G0), mm/s, 1e-6 to 1e6; None: what the velocity limits allow."""

    name: str = ""
    """What people call it; only shown."""

    @property
    def axes(self) -> int:
        """How many axes it has: 2 (X, Y) or 3 (X, Y, Z)."""
        return len(self.velocity_mm_s)

    @staticmethod
    def from_toml(file: str | os.PathLike[str]) -> "Machine":
        """Reads a machine profile, as in deploy/machines. OSError if it cannot be read, ValueError if it is none."""
        return _parse(Path(file).read_text(encoding="utf-8"), os.fspath(file))


def shipped_machines() -> list[str]:
    """The names of the machine profiles that come with kcs, to be given as ``machine=``."""
    return sorted(entry.name.removesuffix(".toml") for entry in (resources.files("kcs") / "machines").iterdir())


def find_machine(machine: Machine | str | os.PathLike[str]) -> Machine:
    """A machine as it is, by the name of its shipped profile, or by the file of its profile. ValueError, OSError."""
    if isinstance(machine, Machine):
        return machine
    if machine in shipped_machines():
        profile = resources.files("kcs") / "machines" / f"{machine}.toml"
        return _parse(profile.read_text(encoding="utf-8"), str(machine))
    if isinstance(machine, str) and not machine.endswith(".toml"):
        known = ", ".join(shipped_machines())
        raise ValueError(f"no machine is called {machine!r}: use one of {known}, a .toml file, or a kcs.Machine")
    return Machine.from_toml(machine)


def _parse(text: str, source: str) -> Machine:
    try:
        profile = tomllib.loads(text)
    except tomllib.TOMLDecodeError as failure:
        raise ValueError(f"{source}: is no TOML: {failure}") from None
    fields = _section(profile, "machine", {"axes": int}, {"name": str}, source)
    per_axis: dict[str, type] = {"velocity_mm_s": list, "acceleration_mm_s2": list, "jerk_mm_s3": list}
    limits = _section(profile, "limits", per_axis, {"rapid_mm_s": (int, float)}, source)
    axes = fields.pop("axes")
    for key in per_axis:
        if len(limits[key]) != axes or not all(isinstance(limit, int | float) for limit in limits[key]):
            raise ValueError(f"{source}: limits.{key} is {limits[key]}: give {axes} numbers, one per axis")
    unknown = profile.keys() - {"machine", "limits"}
    if unknown:
        raise ValueError(f"{source}: {min(unknown)} is not known: a profile has [machine] and [limits]")
    return Machine(**fields, **limits)


def _section(profile: dict[str, Any], name: str, required: Any, optional: Any, source: str) -> dict[str, Any]:
    """The keys of a section, all that are required and none that are not known, each of its type."""
    section = profile.get(name)
    if not isinstance(section, dict):
        raise ValueError(f"{source}: [{name}] is missing")
    known = required | optional
    for key in required.keys() - section.keys():
        raise ValueError(f"{source}: {name}.{key} is missing")
    for key, value in section.items():
        if key not in known:
            raise ValueError(f"{source}: {name}.{key} is not known; known are {', '.join(known)}")
        if not isinstance(value, known[key]):
            raise ValueError(f"{source}: {name}.{key} is {value!r}, which is of the wrong kind")
    return dict(section)


def to_message(machine: Machine) -> _contract.Message:
    return _contract.MachineMessage(
        name=machine.name,
        axes=machine.axes,
        velocity_mm_s=_contract.to_packed(machine.velocity_mm_s),
        acceleration_mm_s2=_contract.to_packed(machine.acceleration_mm_s2),
        jerk_mm_s3=_contract.to_packed(machine.jerk_mm_s3),
        rapid_mm_s=machine.rapid_mm_s,
    )


def from_message(message: _contract.Message) -> Machine:
    return Machine(
        velocity_mm_s=tuple(_contract.from_packed(message.velocity_mm_s).tolist()),
        acceleration_mm_s2=tuple(_contract.from_packed(message.acceleration_mm_s2).tolist()),
        jerk_mm_s3=tuple(_contract.from_packed(message.jerk_mm_s3).tolist()),
        rapid_mm_s=message.rapid_mm_s if message.HasField("rapid_mm_s") else None,
        name=message.name,
    )
