"""Machines by name, from a file and from numbers."""

from pathlib import Path

import pytest

import kcs

PROFILE = """
[machine]
name = "mill"
axes = 2
[limits]
velocity_mm_s = [100, 90]
acceleration_mm_s2 = [1000, 900]
jerk_mm_s3 = [20000, 18000]
"""


def test_the_shipped_ones_go_by_their_names(client: kcs.Client) -> None:
    assert "router" in kcs.shipped_machines()
    for name in kcs.shipped_machines():
        assert client.plan(gcode="G1 X1 F60\n", machine=name).machine.name


def test_a_profile_is_read_from_a_file(client: kcs.Client, tmp_path: Path) -> None:
    file = tmp_path / "mill.toml"
    file.write_text(PROFILE)
    expected = kcs.Machine((100, 90), (1000, 900), (20000, 18000), name="mill")
    assert client.plan(gcode="G1 X1 F60\n", machine=file).machine == expected
    assert client.plan(gcode="G1 X1 F60\n", machine=str(file)).machine == expected


@pytest.mark.parametrize(
    ("before", "after", "problem"),
    [
        ("axes = 2", "", "machine.axes is missing"),
        ("axes = 2", "axes = 3", r"limits.velocity_mm_s is \[100, 90\]: give 3 numbers"),
        ("[100, 90]", '[100, "fast"]', r"limits.velocity_mm_s is \[100, 'fast'\]: give 2 numbers"),
        ("[100, 90]", '"fast"', "limits.velocity_mm_s is 'fast'"),
        ("jerk_mm_s3", "jerk", "limits.jerk_mm_s3 is missing"),
        ("[limits]", "[limits]\nfeed = 3", "limits.feed is not known"),
        ("[limits]", "[limit]", r"\[limits\] is missing"),
        ("axes = 2", "axes: 2", "is no TOML"),
    ],
)
def test_a_profile_that_is_wrong_names_file_and_key(before: str, after: str, problem: str, tmp_path: Path) -> None:
    file = tmp_path / "mill.toml"
    file.write_text(PROFILE.replace(before, after))
    with pytest.raises(ValueError, match=f"mill.toml: {problem}"):
        kcs.Machine.from_toml(file)


def test_an_unknown_name_is_told_those_that_there_are(client: kcs.Client) -> None:
    with pytest.raises(ValueError, match="'mill': use one of .*router"):
        client.plan(gcode="G1 X1 F60\n", machine="mill")
