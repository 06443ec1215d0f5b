"""How to reach a server, and who one is there."""

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import grpc

from kcs._contract import SERVICE

__all__ = ["LOST", "Connection"]

# The codes of calls whose server went away. One behind a balancer that dies ends them as the last two, which kcsd never
# answers to a client that waits.
LOST: Final = ("UNAVAILABLE", "CANCELLED", "UNKNOWN")

# The safe ones: asked twice, each answers as if it had been asked once. A plan's name is made from its request, so that
# holds for CreatePlan, too. gRPC itself tries them again, unless an answer has begun.
_TRIED_AGAIN: Final = ("CreatePlan", "GetPlan", "StreamSetpoints", "DescribeCorners")
_SERVICE_CONFIG: Final = {
    "methodConfig": [
        {
            "name": [{"service": SERVICE, "method": method} for method in _TRIED_AGAIN],
            "retryPolicy": {
                "maxAttempts": 4,
                "initialBackoff": "0.2s",
                "maxBackoff": "2s",
                "backoffMultiplier": 3,
                "retryableStatusCodes": LOST,
            },
        }
    ]
}
# A server that was silent for ten seconds is asked whether it lives, and taken for dead ten seconds later. One that
# answers keeps a call alive, even one that plans for an hour.
_CHANNEL_OPTIONS: Final = (
    ("grpc.keepalive_time_ms", 10_000),
    ("grpc.keepalive_timeout_ms", 10_000),
    ("grpc.http2.max_pings_without_data", 0),
    ("grpc.service_config", json.dumps(_SERVICE_CONFIG)),
)


@dataclass(frozen=True)
class Connection:
    """A server, and how to speak to it. ValueError if that contradicts itself, or would show its token to others."""

    address: str
    """"HOST:PORT" or "unix:/path/of/socket"."""

    tls: bool = False
    """Whether to speak TLS. The server's certificate must be issued for HOST."""

    ca_file: str | os.PathLike[str] | None = None
    """PEM, the roots that the server's certificate must come from; None: the system's."""

    certificate_file: str | os.PathLike[str] | None = None
    """PEM, this client's own certificate (with those between it and the root), for servers that ask for one."""

    key_file: str | os.PathLike[str] | None = None
    """PEM, the key of the certificate: both or neither."""

    token_file: str | os.PathLike[str] | None = None
    """Its first line is the token that says who calls; None: the file that KCS_TOKEN_FILE names, if it is set. Read
    anew for each call, so that the token may be exchanged. Sent over TLS and to this machine only."""

    patience_s: float = 5.0
    """Each call gives up after this time, in seconds, if no server can be reached."""

    def __post_init__(self) -> None:
        if not self.patience_s > 0:
            raise ValueError(f"patience_s is {self.patience_s}: give a time above 0 s")
        if (self.certificate_file is None) != (self.key_file is None):
            raise ValueError("a client's certificate and its key go together: give both, or neither")
        if not self.tls and (self.ca_file or self.certificate_file):
            raise ValueError("certificates are of use with tls=True only")
        if self._token_file and not (self.tls or self._on_this_machine):
            raise ValueError(
                f"without TLS everybody on the way to {self.address} could read the token: use tls=True, or send none"
            )

    @property
    def _token_file(self) -> str | os.PathLike[str] | None:
        return self.token_file or os.environ.get("KCS_TOKEN_FILE") or None

    @property
    def _on_this_machine(self) -> bool:
        host = self.address.rpartition(":")[0]
        return self.address.startswith("unix:") or host in ("localhost", "127.0.0.1", "[::1]")

    def metadata(self) -> tuple[tuple[str, str], ...]:
        """What goes with every call. OSError if the token's file cannot be read, ValueError if it holds none."""
        if not self._token_file:
            return ()
        token = Path(self._token_file).read_text(encoding="ascii").partition("\n")[0].rstrip("\r")
        if not token or not all("!" <= character <= "~" for character in token):
            raise ValueError(f"{self._token_file}: must hold a token in its first line")
        return (("authorization", f"Bearer {token}"),)

    def open_channel(self, library: Any = grpc) -> Any:
        """library: grpc or grpc.aio. Does not connect yet. OSError if a file cannot be read."""
        if not self.tls:
            return library.insecure_channel(self.address, options=_CHANNEL_OPTIONS)
        credentials = grpc.ssl_channel_credentials(
            root_certificates=_read_pem(self.ca_file),
            private_key=_read_pem(self.key_file),
            certificate_chain=_read_pem(self.certificate_file),
        )
        return library.secure_channel(self.address, credentials, options=_CHANNEL_OPTIONS)


def _read_pem(file: str | os.PathLike[str] | None) -> bytes | None:
    if file is None:
        return None
    content = Path(file).read_bytes()
    if b"-----BEGIN " not in content:
        raise ValueError(f"{os.fspath(file)}: is no PEM file")
    return content
