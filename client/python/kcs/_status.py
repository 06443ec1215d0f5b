"""From a failed gRPC call to an Error."""

from typing import Any

from kcs import _contract
from kcs.connection import Connection
from kcs.errors import Error, Violation

# What gRPC says of a connection that failed, and what that means.
_WITH_TLS = {
    "CERTIFICATE_VERIFY_FAILED": "its certificate is not trusted: it has expired, or none of the given roots stands "
    "behind it",
    "certificate verify failed": "its certificate is not trusted: it has expired, or none of the given roots stands "
    "behind it",
    "is not in peer certificate": "its certificate is for another name: use the name that it was issued for",
    "WRONG_VERSION_NUMBER": "it speaks no TLS: connect without, if nobody else is on the way",
    "wrong version number": "it speaks no TLS: connect without, if nobody else is on the way",
    "Socket closed": "it breaks the connection off: it may want a client's certificate, or not trust this one's",
    "empty address list": "this client's certificates cannot be used: does the key belong to the certificate?",
}
_PLAIN = {"Socket closed": "it breaks the connection off: it may speak TLS only"}


def error_of(failure: Any, connection: Connection) -> Error:
    """failure: a grpc.RpcError of a call, sync or asyncio."""
    code = failure.code().name
    message = failure.details() or ""
    violations: list[Violation] = []
    request_id = None
    for key, value in failure.trailing_metadata() or ():
        if key == "grpc-status-details-bin":
            for detail in _contract.Status.FromString(value).details:
                if detail.type_url.endswith("/google.rpc.BadRequest"):
                    refused = _contract.BadRequest.FromString(detail.value)
                    violations += (Violation(one.field, one.description) for one in refused.field_violations)
                elif detail.type_url.endswith("/google.rpc.RequestInfo"):
                    request_id = _contract.RequestInfo.FromString(detail.value).request_id
    if code == "UNAVAILABLE" and request_id is None:
        message = _no_connection(message, connection)
    elif code == "DEADLINE_EXCEEDED":
        message = f"kcsd at {connection.address} took longer than {connection.patience_s:g} s to answer: {message}"
    elif code == "UNAUTHENTICATED":
        message += " (kcs.Connection(…, token_file=…), or KCS_TOKEN_FILE)"
    return Error(code, message, tuple(violations), request_id)


def _no_connection(reason: str, connection: Connection) -> str:
    for sign, meaning in (_WITH_TLS if connection.tls else _PLAIN).items():
        if sign in reason:
            return f"no connection to {connection.address}: {meaning}"
    return (
        f"no kcsd answers at {connection.address}; start one with: kcsd --listen {connection.address} "
        f"(or give no address: kcs starts one by itself) [{reason}]"
    )
