"""Why something failed."""

import os
import re
from dataclasses import dataclass

__all__ = ["Error", "ServerNotFound", "Violation"]

_IN_PROGRAM = re.compile(r"gcode, line (\d+)(?:, column (\d+))?")


@dataclass(frozen=True)
class Violation:
    """One thing that is wrong with a request."""

    field: str
    """Where: "options.machine.jerk_mm_s3[1]", "path.points_mm, segment 17", "gcode, line 12, column 5"."""

    description: str
    """What is wrong, and what to do."""

    file: str | None = None
    """The file that the G-code came from, if it came from one."""

    @property
    def line(self) -> int | None:
        """The line of the G-code, from 1; None if it is not about one."""
        found = _IN_PROGRAM.match(self.field)
        return int(found[1]) if found else None

    @property
    def place(self) -> str:
        """Where, as editors understand it: "part.ngc:12:5"; otherwise the field."""
        found = _IN_PROGRAM.match(self.field)
        if not found or not self.file:
            return self.field
        return ":".join(part for part in (self.file, *found.groups()) if part)

    def __str__(self) -> str:
        return f"{self.place}: {self.description}"


class Error(Exception):
    """The server refused a call, or did not answer. Its text says where, what is wrong, and what to do."""

    def __init__(
        self, code: str, message: str, violations: tuple[Violation, ...] = (), request_id: str | None = None
    ) -> None:
        super().__init__("\n".join(map(str, violations)) or message)
        self.code = code
        """Name of the gRPC status code: "INVALID_ARGUMENT", "NOT_FOUND", "UNAVAILABLE", …"""
        self.violations = violations
        """What is wrong with the request; empty if the failure is not about its content."""
        self.request_id = request_id
        """What the server's log calls the call; None if no server answered."""

    def in_file(self, file: str | os.PathLike[str]) -> "Error":
        """The same error of a program that came from a file."""
        named = tuple(Violation(one.field, one.description, os.fspath(file)) for one in self.violations)
        return Error(self.code, str(self), named, self.request_id)


class ServerNotFound(Exception):
    """No server address was given, and no kcsd was found to start, or it did not start."""
