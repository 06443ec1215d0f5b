"""A server of one's own, for clients that are given no address."""

import os
import shutil
import subprocess
import sys
import tempfile
import weakref
from pathlib import Path
from typing import Final

from kcs.errors import ServerNotFound

# Waits for its input to end, which it does when this process ends, however it does; then ends the server as well.
_WATCHMAN: Final = """
"$1" --config "$2/kcsd.toml" 2>"$2/log" </dev/null &
exec >&-
read -r _
kill $!
wait $!
rm -rf "$2"
"""

# The caps protect a server that many share; here the user's own memory is the only one. A program goes into the store
# in one piece, and points are no more than a server can be told to take.
_SETTINGS: Final = """
[server]
listen = "unix:{folder}/socket"
grace_s = 0.0
log_level = "warning"
[store]
database = "memory"
[caps]
points_per_plan = 20_000_000
gcode_bytes = 1_073_741_824
"""


def find_kcsd() -> Path:
    """The server's program: what KCS_SERVER names; beside the Python program; on the PATH; or where it is built in the
    source tree that holds this package or the current folder. ServerNotFound if it is nowhere.
    """
    named = os.environ.get("KCS_SERVER")
    if named:
        if not os.access(named, os.X_OK):
            raise ServerNotFound(f"KCS_SERVER names {named}, which is no program: give the path of kcsd, or unset it")
        return Path(named)
    places = [Path(sys.executable).parent / "kcsd"]
    on_path = shutil.which("kcsd")
    if on_path:
        places.append(Path(on_path))
    for folder in (*Path(__file__).resolve().parents, *Path.cwd().parents, Path.cwd()):
        if (folder / "proto" / "kcs" / "v1" / "planning.proto").is_file():
            places.append(folder / "build" / "release" / "server" / "kcsd")
    for place in places:
        if os.access(place, os.X_OK):
            return place
    raise ServerNotFound(
        "no server address was given, and there is no kcsd to start: build it (./run kcsd --version), then set "
        "KCS_SERVER to its path (build/release/server/kcsd), or put it on the PATH"
    )


class EmbeddedServer:
    """A kcsd on a socket that this user alone can reach, with a store in memory. It ends with this object, or with this
    process, even if that is killed.
    """

    def __init__(self) -> None:
        """Waits until it serves. ServerNotFound if it cannot be found or does not start."""
        program = find_kcsd()
        folder = tempfile.mkdtemp(prefix="kcs-server-")
        Path(folder, "kcsd.toml").write_text(_SETTINGS.format(folder=folder), encoding="utf-8")
        watchman = subprocess.Popen(
            ["/bin/sh", "-c", _WATCHMAN, "kcs", program, folder],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            # Ctrl-C interrupts a call, not the server.
            start_new_session=True,
        )
        assert watchman.stdout is not None
        with watchman.stdout as output:
            started = output.readline().startswith(b"kcsd listens")
        log = "" if started else Path(folder, "log").read_text(encoding="utf-8", errors="replace").strip()
        self._close = weakref.finalize(self, _end, watchman)
        self.address = f"unix:{folder}/socket"
        if not started:
            self._close()
            raise ServerNotFound(f"{program} did not start: {log}")

    def close(self) -> None:
        """Ends the server; further calls do nothing."""
        self._close()


def _end(watchman: "subprocess.Popen[bytes]") -> None:
    assert watchman.stdin is not None
    watchman.stdin.close()
    watchman.wait()
