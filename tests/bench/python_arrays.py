"""How fast a batch of setpoints becomes NumPy arrays: read as bytes, as the package does it, and number by number."""

import timeit
from importlib import resources
from typing import Any

import numpy as np
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from kcs import _contract

SETPOINTS, AXES, ROUNDS = 32768, 3, 20


def class_as_written() -> Any:
    """SetpointBatch with repeated doubles, as the contract has it."""
    files = descriptor_pb2.FileDescriptorSet.FromString((resources.files("kcs") / "contract.binpb").read_bytes())
    pool = descriptor_pool.DescriptorPool()
    for file in files.file:
        pool.AddSerializedFile(file.SerializeToString())
    descriptor = pool.FindMessageTypeByName("kcs.v1.SetpointBatch")
    if hasattr(message_factory, "GetMessageClass"):
        return message_factory.GetMessageClass(descriptor)
    return message_factory.MessageFactory(pool).GetPrototype(descriptor)


def main() -> None:
    as_written, as_bytes = class_as_written(), _contract.message_class("kcs.v1.SetpointBatch")
    batch = as_bytes()
    for axis in range(AXES):
        batch.position_mm.add().values.extend(_contract.to_packed(np.arange(SETPOINTS) + axis / 8))
    wire = batch.SerializeToString()

    def by_bytes() -> list[Any]:
        return [_contract.from_packed(column.values) for column in as_bytes.FromString(wire).position_mm]

    def by_array() -> list[Any]:
        return [np.array(column.values) for column in as_written.FromString(wire).position_mm]

    def by_iterator() -> list[Any]:
        columns = [column.values for column in as_written.FromString(wire).position_mm]
        return [np.fromiter(values, np.float64, len(values)) for values in columns]

    fastest = 0.0
    for name, read in (("bytes", by_bytes), ("np.array", by_array), ("np.fromiter", by_iterator)):
        seconds = min(timeit.repeat(read, number=ROUNDS, repeat=5)) / ROUNDS
        fastest = fastest or seconds
        print(
            f"{name:12} {SETPOINTS / seconds / 1e6:8.2f} million setpoints/s   {seconds / fastest:6.1f} × the time of bytes"
        )


if __name__ == "__main__":
    main()
