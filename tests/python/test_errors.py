"""Errors say where, what and what to do."""

import socket
import time
from pathlib import Path

import numpy as np
import pytest

import kcs


def test_a_mistake_in_a_file_has_file_line_and_column(client: kcs.Client, tmp_path: Path) -> None:
    file = tmp_path / "part.nc"
    file.write_text("G1 X1 F600\nG1 X[1/0]\n")
    with pytest.raises(kcs.Error) as failure:
        client.plan(gcode=file, machine="router")
    error = failure.value
    assert error.code == "INVALID_ARGUMENT"
    [violation] = error.violations
    assert violation.line == 2
    assert violation.place == f"{file}:2:7"
    assert "division by zero" in violation.description
    assert str(error) == f"{file}:2:7: {violation.description}"
    assert error.request_id


def test_a_mistake_in_a_text_has_line_and_column(client: kcs.Client) -> None:
    with pytest.raises(kcs.Error, match="^gcode, line 2, column 7: a division by zero"):
        client.plan(gcode="G1 X1 F600\nG1 X[1/0]\n", machine="router")


def test_every_field_that_is_wrong_is_named(client: kcs.Client) -> None:
    machine = kcs.Machine([100, 100], [-1, 1000], [1e4, float("inf")])
    with pytest.raises(kcs.Error) as failure:
        client.plan(gcode="G1 X1 F600\n", machine=machine, tolerance=-1)
    assert {violation.field for violation in failure.value.violations} == {
        "options.machine.acceleration_mm_s2[0]",
        "options.machine.jerk_mm_s3[1]",
        "options.tolerance_mm",
    }
    assert failure.value.violations[0].line is None


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        ({}, "either gcode or points"),
        ({"gcode": "G1", "points": [[0, 0]]}, "either gcode or points"),
        ({"points": [0, 1, 2]}, "one row per point"),
        ({"points": np.zeros((3, 2))}, "of 3 numbers in mm, as the machine has 3 axes"),
        ({"points": np.zeros((3, 3)), "feed": [1, 2]}, "feed has the shape"),
        ({"points": np.zeros((3, 3)), "stops": {3: 0.0}}, "stops names point 3"),
        ({"gcode": "G1", "feed": [1, 2]}, "single numbers"),
        ({"gcode": "G1", "strategy": "fastest"}, "strategy is 'fastest': use one of auto, interrupted"),
    ],
)
def test_arguments_that_do_not_fit_are_told_before_anything_is_sent(
    client: kcs.Client, arguments: dict[str, object], problem: str
) -> None:
    with pytest.raises(ValueError, match=problem):
        client.plan(machine="router", **arguments)  # type: ignore[arg-type]


def test_the_name_of_a_file_is_not_taken_for_a_program(client: kcs.Client, data: Path) -> None:
    with pytest.raises(ValueError, match="pathlib.Path"):
        client.plan(machine="router", gcode=str(data / "circle.nc"))


def test_nobody_at_the_address_is_told_with_what_to_do() -> None:
    with socket.socket() as taken:
        taken.bind(("localhost", 0))  # and does not listen
        address = f"localhost:{taken.getsockname()[1]}"
        with kcs.Client(address) as client, pytest.raises(kcs.Error) as failure:
            client.plan(gcode="G1 X1 F600\n", machine="router")
    assert failure.value.code == "UNAVAILABLE"
    assert f"start one with: kcsd --listen {address}" in str(failure.value)


def test_a_server_that_is_silent_is_given_up_when_the_patience_is_over() -> None:
    with socket.socket() as silent:
        silent.bind(("localhost", 0))
        silent.listen()  # and never says a word
        connection = kcs.Connection(f"localhost:{silent.getsockname()[1]}", patience_s=0.5)
        began = time.monotonic()
        with kcs.Client(connection) as client, pytest.raises(kcs.Error) as failure:
            client.plan(gcode="G1 X1 F600\n", machine="router")
    assert failure.value.code in ("DEADLINE_EXCEEDED", "UNAVAILABLE")
    assert time.monotonic() - began < 15
