"""The server that a client starts for itself."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

import kcs


def folder_of(client: kcs.Client) -> Path:
    return Path(client._connection.address.removeprefix("unix:")).parent


def becomes_true(condition: Callable[[], bool]) -> bool:
    deadline = time.monotonic() + 30
    while time.monotonic() < deadline:
        if condition():
            return True
        time.sleep(0.02)
    return False


def serves(folder: Path) -> bool:
    """Whether a process has this folder's settings. Those that end while one looks have not."""
    for entry in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if f"{folder}/kcsd.toml".encode() in entry.read_bytes():
                return True
        except OSError:
            continue
    return False


def test_it_ends_with_the_client_and_leaves_nothing() -> None:
    with kcs.Client() as client:
        folder = folder_of(client)
        assert serves(folder)
        assert folder.stat().st_mode & 0o077 == 0
    assert not serves(folder)
    assert not folder.exists()


def test_it_ends_when_nobody_uses_the_client_any_more() -> None:
    client = kcs.Client()
    plan = client.plan(gcode="G1 X1 F600\n", machine="router")
    folder = folder_of(client)
    del client
    assert len(plan.setpoints(0.01)) > 1  # the plan uses it
    del plan
    assert becomes_true(lambda: not folder.exists())


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM, None])
def test_it_ends_with_the_process_however_that_ends(how: signal.Signals | None) -> None:
    script = "import kcs, sys; client = kcs.Client(); print(client._connection.address, flush=True); sys.stdin.read()"
    process = subprocess.Popen([sys.executable, "-c", script], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert process.stdin is not None and process.stdout is not None
    with process:
        folder = Path(process.stdout.readline().strip().removeprefix("unix:")).parent
        assert serves(folder)
        if how is None:
            process.stdin.close()
        else:
            process.send_signal(how)
    assert becomes_true(lambda: not serves(folder) and not folder.exists())


def test_no_server_to_start_is_told_with_what_to_do(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("KCS_SERVER", str(tmp_path / "kcsd"))
    with pytest.raises(kcs.ServerNotFound, match="KCS_SERVER names .*: give the path of kcsd, or unset it"):
        kcs.Client()


def test_a_server_that_does_not_start_says_why(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    broken = tmp_path / "kcsd"
    broken.write_text("#!/bin/sh\necho 'no memory left' >&2\nexit 1\n")
    broken.chmod(0o755)
    monkeypatch.setenv("KCS_SERVER", str(broken))
    with pytest.raises(kcs.ServerNotFound, match="did not start: no memory left"):
        kcs.Client()


def test_it_is_found_on_the_path(monkeypatch: pytest.MonkeyPatch, kcsd: str) -> None:
    monkeypatch.delenv("KCS_SERVER")
    monkeypatch.setenv("PATH", os.path.dirname(kcsd) + ":" + os.environ["PATH"])
    with kcs.Client() as client:
        assert client.plan(gcode="G1 X1 F600\n", machine="router").summary.cycle_time_s > 0
