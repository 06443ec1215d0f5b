"""TLS and tokens."""

import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

import kcs
from conftest import RunningServer

pytestmark = pytest.mark.skipif(not shutil.which("openssl"), reason="openssl, which makes the certificates, is missing")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """With a certificate of localhost that stands for itself, and a token."""
    subprocess.run(
        [
            "openssl",
            "req",
            "-x509",
            "-newkey",
            "ec",
            "-pkeyopt",
            "ec_paramgen_curve:prime256v1",
            "-nodes",
            "-days",
            "2",
            "-subj",
            "/CN=localhost",
            "-addext",
            "subjectAltName=DNS:localhost",
            "-keyout",
            "key.pem",
            "-out",
            "cert.pem",
        ],
        cwd=tmp_path,
        check=True,
        capture_output=True,
    )
    return tmp_path


@pytest.fixture
def secure(kcsd: str, folder: Path) -> Iterator[RunningServer]:
    made = subprocess.run([kcsd, "--new-token"], check=True, capture_output=True, text=True)
    (folder / "token").write_text(made.stdout)
    asked = subprocess.run([kcsd, "--hash-token"], input=made.stdout, check=True, capture_output=True, text=True)
    digest = asked.stdout[asked.stdout.index("sha256:") :][: len("sha256:") + 64]
    settings = f"""
[security]
certificate = "{folder}/cert.pem"
key = "{folder}/key.pem"
[[tokens]]
hash = "{digest}"
owner = "cam"
roles = ["plan", "stream"]
"""
    running = RunningServer(kcsd, folder, settings)
    yield running
    running.stop()


def plan(connection: kcs.Connection) -> kcs.Plan:
    return kcs.Client(connection).plan(gcode="G1 X1 F600\n", machine="router")


def test_certificate_and_token_open_the_door(secure: RunningServer, folder: Path) -> None:
    connection = kcs.Connection(secure.address, tls=True, ca_file=folder / "cert.pem", token_file=folder / "token")
    assert len(plan(connection).setpoints(0.01)) > 1


def test_without_a_token_one_is_told_how_to_give_it(secure: RunningServer, folder: Path) -> None:
    with pytest.raises(kcs.Error) as failure:
        plan(kcs.Connection(secure.address, tls=True, ca_file=folder / "cert.pem"))
    assert failure.value.code == "UNAUTHENTICATED"
    assert "token_file" in str(failure.value)


def test_a_server_whose_certificate_is_not_trusted_is_not_believed(secure: RunningServer) -> None:
    with pytest.raises(kcs.Error) as failure:
        plan(kcs.Connection(secure.address, tls=True))
    assert failure.value.code == "UNAVAILABLE"
    assert f"no connection to {secure.address}" in str(failure.value)


def test_a_token_goes_over_plain_connections_to_this_machine_only(server: RunningServer, tmp_path: Path) -> None:
    token = tmp_path / "token"
    token.write_text("secret\n")
    assert plan(kcs.Connection(server.address, token_file=token)).summary.cycle_time_s > 0
    with pytest.raises(ValueError, match="could read the token"):
        kcs.Connection("planner.example.com:50551", token_file=token)


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        ({"tls": True, "key_file": "key.pem"}, "go together"),
        ({"ca_file": "cert.pem"}, "tls=True only"),
        ({"patience_s": 0}, "above 0 s"),
    ],
)
def test_a_connection_that_contradicts_itself_is_refused(arguments: dict[str, object], problem: str) -> None:
    with pytest.raises(ValueError, match=problem):
        kcs.Connection("localhost:50551", **arguments)  # type: ignore[arg-type]


def test_a_file_without_a_token_is_named(server: RunningServer, tmp_path: Path) -> None:
    token = tmp_path / "token"
    token.write_text("\n")
    with pytest.raises(ValueError, match="token: must hold a token in its first line"):
        plan(kcs.Connection(server.address, token_file=token))
