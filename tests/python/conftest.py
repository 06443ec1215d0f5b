"""The package against the real server. KCS_SERVER must name kcsd; PYTHONPATH the package, unless it is installed."""

import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import kcs

SOURCE = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def kcsd() -> str:
    return os.environ["KCS_SERVER"]


@pytest.fixture(scope="session")
def data() -> Path:
    return SOURCE / "tests" / "data"


@pytest.fixture(scope="session")
def client() -> Iterator[kcs.Client]:
    with kcs.Client() as embedded:
        yield embedded


@pytest.fixture(scope="session")
def table() -> kcs.Machine:
    """The X-Y table of the paper's worked example."""
    return kcs.Machine([500, 500], [2500, 2500], [2e5, 2e5], name="table")


@pytest.fixture(scope="session")
def circle(client: kcs.Client, table: kcs.Machine) -> kcs.Plan:
    """A circle of 3 mm in 0.1 mm chords, taken in one smooth motion."""
    angles = np.linspace(0, 2 * np.pi, 189)
    points = 3 * np.column_stack((np.cos(angles), np.sin(angles)))
    return client.plan(points=points, machine=table, tolerance=0.01, feed=50)


class RunningServer:
    """A kcsd on a TCP port, with settings of its own."""

    def __init__(self, program: str, folder: Path, settings: str = "") -> None:
        config = folder / "kcsd.toml"
        config.write_text('[server]\nlisten = "localhost:0"\ngrace_s = 0.0\n[store]\ndatabase = "memory"\n' + settings)
        self.process = subprocess.Popen([program, "--config", config, "--log-level", "off"], stdout=subprocess.PIPE)
        assert self.process.stdout is not None
        announcement = self.process.stdout.readline().decode()
        self.port = int(announcement.rsplit(":", 1)[1])
        self.address = f"localhost:{self.port}"

    def stop(self) -> None:
        self.process.kill()
        self.process.wait()
        assert self.process.stdout is not None
        self.process.stdout.close()


@pytest.fixture
def server(kcsd: str, tmp_path: Path) -> Iterator[RunningServer]:
    running = RunningServer(kcsd, tmp_path)
    yield running
    running.stop()
