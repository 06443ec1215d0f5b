"""The messages and methods of the contract (proto/kcs/v1/planning.proto).

They are made from a descriptor set when the package is imported, so there is no generated code: that works only with
the protobuf releases near the one that generated it, and this package is to run with Debian's and with the latest.

One thing differs from the contract as it is written: every ``repeated double`` is read as ``repeated bytes``. On the
wire both are the same, as a packed array of doubles is one field of bytes; but the bytes become a NumPy array at the
speed of a memory copy, where protobuf would make a Python number of each double.
"""

from collections.abc import Callable, Iterable
from importlib import resources
from typing import Any, Final

import numpy as np
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory

from kcs._arrays import FloatArray

SERVICE: Final = "kcs.v1.PlanningService"

# How each is called, and the message or messages that it answers.
_METHODS: Final = {
    "CreatePlan": ("stream_unary", "kcs.v1.Plan"),
    "GetPlan": ("unary_unary", "kcs.v1.Plan"),
    "DeletePlan": ("unary_unary", "google.protobuf.Empty"),
    "StreamSetpoints": ("unary_stream", "kcs.v1.SetpointBatch"),
    "DescribeCorners": ("unary_stream", "kcs.v1.CornerBatch"),
}

# Messages have no static types: their classes exist at run time alone.
Message = Any

_WIRE_DOUBLE: Final = np.dtype("<f8")


def _load() -> Any:
    files = descriptor_pb2.FileDescriptorSet.FromString((resources.files("kcs") / "contract.binpb").read_bytes())
    # A pool of our own: other packages may have registered files of the same names, such as google/rpc/*.proto.
    pool = descriptor_pool.DescriptorPool()
    for file in files.file:
        for message in file.message_type:
            _read_doubles_as_bytes(message)
        pool.AddSerializedFile(file.SerializeToString())
    return pool


def _read_doubles_as_bytes(message: Any) -> None:
    for field in message.field:
        if field.type == field.TYPE_DOUBLE and field.label == field.LABEL_REPEATED:
            field.type = field.TYPE_BYTES
    for nested in message.nested_type:
        _read_doubles_as_bytes(nested)


_pool = _load()


def message_class(name: str) -> Any:
    descriptor = _pool.FindMessageTypeByName(name)
    if hasattr(message_factory, "GetMessageClass"):  # protobuf 4.22 and later
        return message_factory.GetMessageClass(descriptor)
    return message_factory.MessageFactory(_pool).GetPrototype(descriptor)


CreatePlanRequest: Final = message_class("kcs.v1.CreatePlanRequest")
PlanOptions: Final = message_class("kcs.v1.PlanOptions")
PathChunk: Final = message_class("kcs.v1.PathChunk")
MachineMessage: Final = message_class("kcs.v1.Machine")
PlanMessage: Final = message_class("kcs.v1.Plan")
GetPlanRequest: Final = message_class("kcs.v1.GetPlanRequest")
DeletePlanRequest: Final = message_class("kcs.v1.DeletePlanRequest")
StreamSetpointsRequest: Final = message_class("kcs.v1.StreamSetpointsRequest")
DescribeCornersRequest: Final = message_class("kcs.v1.DescribeCornersRequest")
Status: Final = message_class("google.rpc.Status")
BadRequest: Final = message_class("google.rpc.BadRequest")
RequestInfo: Final = message_class("google.rpc.RequestInfo")


def enum_values(name: str) -> dict[str, int]:
    """The values of an enumeration of kcs.v1 without what they have in common: {"auto": 1, "interrupted": 2, …}."""
    unspecified, *values = _pool.FindEnumTypeByName(f"kcs.v1.{name}").values
    common = len(unspecified.name) - len("UNSPECIFIED")
    return {value.name[common:].lower(): value.number for value in values}


def method(channel: Any, name: str) -> Callable[..., Any]:
    """The method of the planning service, to be called over a channel of grpc or of grpc.aio."""
    kind, answer = _METHODS[name]
    return getattr(channel, kind)(  # type: ignore[no-any-return]
        f"/{SERVICE}/{name}",
        request_serializer=lambda message: message.SerializeToString(),
        response_deserializer=message_class(answer).FromString,
    )


def to_packed(values: Any) -> list[bytes]:
    """Numbers as the content of a field that the contract calls ``repeated double``."""
    array = np.ascontiguousarray(values, dtype=_WIRE_DOUBLE)
    return [array.tobytes()] if array.size else []


def from_packed(pieces: Iterable[bytes]) -> FloatArray:
    """The numbers of a field that the contract calls ``repeated double``, read-only."""
    return np.frombuffer(b"".join(pieces), dtype=_WIRE_DOUBLE)
