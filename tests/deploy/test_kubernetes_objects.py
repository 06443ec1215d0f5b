"""deploy/kubernetes, as kustomize builds it: valid objects, which find each other by their names."""

import subprocess
from pathlib import Path
from typing import Iterator

import pytest
import yaml
from kubernetes_schema import Object, problems

FOLDER = Path(__file__).parents[2] / "deploy" / "kubernetes"


@pytest.fixture(scope="module")
def objects() -> list[Object]:
    built = subprocess.run(["kubectl", "kustomize", FOLDER], capture_output=True, text=True)
    assert built.returncode == 0, built.stderr
    return list(yaml.safe_load_all(built.stdout))


def of_kind(objects: list[Object], kind: str) -> list[Object]:
    found = [thing for thing in objects if thing["kind"] == kind]
    assert found, f"there is no {kind}"
    return found


def pods(objects: list[Object]) -> list[Object]:
    return [thing["spec"]["template"] for thing in of_kind(objects, "Deployment")]


def selected(objects: list[Object], labels: dict[str, str]) -> list[Object]:
    found = [pod for pod in pods(objects) if labels.items() <= pod["metadata"]["labels"].items()]
    assert found, f"no pod has the labels {labels}"
    return found


def port_names(pod: Object) -> set[str]:
    return {port["name"] for container in pod["spec"]["containers"] for port in container["ports"]}


def test_objects_are_valid(objects: list[Object]) -> None:
    wrong = [problem for thing in objects for problem in problems(thing)]
    assert not wrong, "\n".join(wrong)


def test_containers_have_probes_bounds_and_no_rights(objects: list[Object]) -> None:
    for pod in pods(objects):
        assert pod["spec"]["securityContext"]["runAsNonRoot"]
        for container in pod["spec"]["containers"]:
            for probe in ("livenessProbe", "readinessProbe"):
                assert container[probe]["httpGet"]["port"] in port_names(pod), probe
            assert {"requests", "limits"} <= container["resources"].keys()
            assert container["securityContext"]["readOnlyRootFilesystem"]
            assert container["securityContext"]["capabilities"] == {"drop": ["ALL"]}


def test_services_lead_to_ports_of_pods(objects: list[Object]) -> None:
    services = of_kind(objects, "Service")
    assert any(service["spec"].get("clusterIP") == "None" for service in services), "none is headless"
    for service in services:
        for pod in selected(objects, service["spec"]["selector"]):
            assert {port["targetPort"] for port in service["spec"]["ports"]} <= port_names(pod)


def test_network_policies_name_ports_of_pods(objects: list[Object]) -> None:
    for policy in of_kind(objects, "NetworkPolicy"):
        for pod in selected(objects, policy["spec"]["podSelector"]["matchLabels"]):
            ports = {port["port"] for rule in policy["spec"]["ingress"] for port in rule["ports"]}
            assert ports <= port_names(pod)


def test_disruption_budget_and_autoscaler_are_about_servers_that_are_there(objects: list[Object]) -> None:
    for budget in of_kind(objects, "PodDisruptionBudget"):
        assert selected(objects, budget["spec"]["selector"]["matchLabels"])
    deployments = {thing["metadata"]["name"] for thing in of_kind(objects, "Deployment")}
    for scaler in of_kind(objects, "HorizontalPodAutoscaler"):
        assert scaler["spec"]["scaleTargetRef"]["name"] in deployments
        assert scaler["spec"]["minReplicas"] > 1


def config_maps(pod: Object) -> Iterator[str]:
    for volume in pod["spec"]["volumes"]:
        if "configMap" in volume:
            yield volume["configMap"]["name"]


def test_pods_mount_what_is_there(objects: list[Object]) -> None:
    settings = {thing["metadata"]["name"] for thing in of_kind(objects, "ConfigMap")}
    for pod in pods(objects):
        volumes = {volume["name"] for volume in pod["spec"]["volumes"]}
        mounted = {mount["name"] for container in pod["spec"]["containers"] for mount in container["volumeMounts"]}
        assert mounted == volumes
        assert set(config_maps(pod)) <= settings
