"""The post-processor and the macro inside the real FreeCAD, on a job that a script builds."""

import os
import re
import subprocess
from pathlib import Path

import kcs
import pytest

SOURCE = Path(__file__).resolve().parents[2]


class FreeCad:
    """A FreeCAD with a home of its own, in which kcs is installed as a user does it."""

    def __init__(self, home: Path) -> None:
        self.home = home
        self.environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"} | {
            "HOME": str(home)
        }
        installed = subprocess.run(
            [SOURCE / "client" / "freecad" / "install.sh"],
            env=self.environment,
            check=True,
            capture_output=True,
            text=True,
        )
        self.macros = Path(installed.stdout.removeprefix("installed in ").strip())

    def post(self, arguments: str = "", post: str = "kcs", macro: str = "") -> "Posted":
        program = self.home / f"{post}.ngc"
        variables = {
            "KCS_TEST_POST": post,
            "KCS_TEST_ARGUMENTS": "--no-show-editor --no-header " + arguments,
            "KCS_TEST_OUTPUT": str(program),
            "KCS_TEST_MACRO": macro and str(self.macros / macro),
        }
        ran = subprocess.run(
            ["freecadcmd", Path(__file__).with_name("job.py")],
            env=self.environment | variables,
            text=True,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=240,
        )
        return Posted(program, ran.stdout)


class Posted:
    def __init__(self, program: Path, output: str) -> None:
        self.program = program
        self.report = program.with_suffix(".kcs.txt")
        self.output = output


@pytest.fixture
def freecad(tmp_path: Path) -> FreeCad:
    return FreeCad(tmp_path)


def cycle_time(text: str) -> float:
    found = re.search(r"Cycle time .*\((.*) s\)", text)
    assert found, text
    return float(found[1])


def test_a_posted_job_has_its_cycle_time_and_slow_spots_in_the_report(freecad: FreeCad) -> None:
    posted = freecad.post("--machine machining-center --tolerance 0.03 --spots 4")
    report = posted.report.read_text()
    with kcs.Client() as client:
        plan = client.plan(gcode=posted.program, machine="machining-center", tolerance=0.03)
        slowest = kcs.slowest_spots(plan.corners(), 4)
    assert cycle_time(report) == pytest.approx(plan.summary.cycle_time_s, abs=6e-4)
    assert plan.summary.cycle_time_s > 1
    assert f"on {plan.machine.name}, tolerance 0.03 mm" in report
    spots = report[report.index("Slowest spots") : report.index("Notices")].strip().splitlines()[2:]
    assert [int(row.split()[0]) for row in spots] == slowest["line"].tolist()
    assert {row.split("  ")[-1] for row in spots} >= {"Pocket", "Outline"}
    assert report in posted.output  # the report view


def test_the_program_is_what_freecads_own_post_processor_writes(freecad: FreeCad) -> None:
    own = freecad.post("--precision=4", post="linuxcnc").program.read_text()
    assert freecad.post("--precision=4 --tolerance=0.02").program.read_text() == own
    assert "G1 " in own


def test_without_a_server_the_program_is_written_all_the_same(freecad: FreeCad) -> None:
    posted = freecad.post("--server localhost:1")
    assert "M2" in posted.program.read_text()
    assert not posted.report.exists()
    assert "kcs: no cycle time: no kcsd answers at localhost:1" in posted.output


def test_an_unknown_machine_is_told_those_that_there_are(freecad: FreeCad) -> None:
    posted = freecad.post("--machine mill")
    assert posted.program.exists()
    assert "no machine is called 'mill': use one of machining-center, router" in posted.output


def test_an_argument_that_is_no_number_is_told(freecad: FreeCad) -> None:
    assert "kcs: argument --tolerance: invalid float value: 'fine'" in freecad.post("--tolerance fine").output


def test_the_macro_shows_the_cycle_time_and_changes_nothing(freecad: FreeCad) -> None:
    posted = freecad.post(macro="kcs_cycle_time.FCMacro")
    assert cycle_time(posted.output) > 1
    assert "Slowest spots" in posted.output
    assert not posted.program.exists()
