"""The check of Kubernetes' objects finds what is wrong with them."""

import copy

import pytest
from kubernetes_schema import Object, problems

SERVER = {
    "apiVersion": "apps/v1",
    "kind": "Deployment",
    "metadata": {"name": "kcsd", "labels": {"a": "b"}},
    "spec": {
        "selector": {"matchLabels": {"a": "b"}},
        "template": {
            "metadata": {"labels": {"a": "b"}},
            "spec": {
                "containers": [
                    {
                        "name": "kcsd",
                        "livenessProbe": {"httpGet": {"path": "/healthz", "port": "http"}, "periodSeconds": 10},
                        "resources": {"limits": {"memory": "4Gi"}},
                    }
                ]
            },
        },
    },
}


@pytest.fixture
def server() -> Object:
    return copy.deepcopy(SERVER)


@pytest.fixture
def container(server: Object) -> Object:
    return server["spec"]["template"]["spec"]["containers"][0]


CONTAINER = "Deployment/kcsd spec.template.spec.containers[0]"


def test_takes_what_is_valid(server: Object) -> None:
    assert problems(server) == []


def test_a_port_is_a_number_or_a_name(server: Object, container: Object) -> None:
    container["livenessProbe"]["httpGet"]["port"] = 50552
    assert problems(server) == []


def test_finds_an_unknown_field(server: Object, container: Object) -> None:
    container["livenessProbe"]["period"] = 10
    assert problems(server) == [f"{CONTAINER}.livenessProbe.period: unknown field"]


def test_finds_a_missing_field(server: Object, container: Object) -> None:
    del container["livenessProbe"]["httpGet"]["port"]
    assert problems(server) == [f"{CONTAINER}.livenessProbe.httpGet.port: missing"]


@pytest.mark.parametrize("wrong", ["10", True, None, [10]])
def test_finds_a_wrong_type(server: Object, container: Object, wrong: object) -> None:
    container["livenessProbe"]["periodSeconds"] = wrong
    assert problems(server) == [f"{CONTAINER}.livenessProbe.periodSeconds: is {wrong!r}, not of type int"]


def test_finds_a_wrong_type_among_named_values(server: Object, container: Object) -> None:
    container["resources"]["limits"]["memory"] = 4
    assert problems(server) == [f"{CONTAINER}.resources.limits.memory: is 4, not of type str"]


def test_finds_a_list_that_is_none(server: Object, container: Object) -> None:
    container["args"] = "--config"
    assert problems(server) == [f"{CONTAINER}.args: is '--config', not a list"]


def test_finds_a_mapping_that_is_none(server: Object) -> None:
    server["spec"]["template"]["spec"] = None
    assert problems(server) == ["Deployment/kcsd spec.template.spec: is None, not a mapping"]


def test_finds_every_problem(server: Object, container: Object) -> None:
    container["imagePolicy"] = "Always"
    del container["name"]
    server["spec"]["replicas"] = "3"
    assert len(problems(server)) == 3


@pytest.mark.parametrize("version", ["v1", "apps/v1beta9", "extensions/v1", ""])
def test_finds_a_kind_that_the_version_does_not_have(server: Object, version: str) -> None:
    server["apiVersion"] = version
    assert problems(server) == [f"Deployment/kcsd: there is no Deployment in {version}"]
