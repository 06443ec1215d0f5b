"""The package speaks the contract as it is written."""

import shutil
import subprocess
import sys
from importlib import resources
from importlib.util import find_spec
from pathlib import Path

import pytest
from google.protobuf import descriptor_pb2

PACKAGE = Path(__file__).resolve().parents[2] / "client" / "python"


def test_its_descriptors_are_those_of_the_proto_files(tmp_path: Path) -> None:
    if not shutil.which("protoc"):
        pytest.skip("protoc is not installed")
    made = tmp_path / "contract.binpb"
    subprocess.run([PACKAGE / "update_contract.sh", made], check=True)
    read = descriptor_pb2.FileDescriptorSet.FromString
    same = read(made.read_bytes()) == read((resources.files("kcs") / "contract.binpb").read_bytes())
    assert same, "proto/ has changed: run client/python/update_contract.sh"


def test_it_lives_beside_other_packages_that_know_the_same_messages() -> None:
    script = """
from google.protobuf import descriptor_pb2, descriptor_pool
file = descriptor_pb2.FileDescriptorProto(name="google/rpc/error_details.proto", package="google.rpc", syntax="proto3")
file.message_type.add(name="BadRequest").field.add(name="other", number=7, type=5, label=1)
descriptor_pool.Default().AddSerializedFile(file.SerializeToString())
import kcs
"""
    subprocess.run([sys.executable, "-c", script], check=True)


def test_its_types_are_sound() -> None:
    if not find_spec("mypy"):
        pytest.skip("mypy is not installed")
    checked = subprocess.run([sys.executable, "-m", "mypy"], cwd=PACKAGE, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout
