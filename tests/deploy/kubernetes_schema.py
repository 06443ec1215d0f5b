"""Whether objects are valid for Kubernetes' API, by the classes that its Python client has for all of them.

Finds fields that are unknown, of a wrong type, or missing. Not which words a field of text may hold, nor which numbers
are in range: the classes do not know.
"""

import re
from typing import Any, Iterator

import kubernetes.client
from kubernetes.client import Configuration

# Debian 12 has the classes of Kubernetes 1.22. Later versions of an API that have the same fields, by theirs there:
SAME_FIELDS = {"autoscaling/v2": "autoscaling/v2beta2"}

PLAIN = {"str": (str,), "int": (int,), "float": (int, float), "bool": (bool,), "datetime": (str,)}

Object = dict[str, Any]


def problems(thing: Object) -> list[str]:
    """What is wrong with an object, each with its place."""
    version, kind = thing.get("apiVersion", ""), thing.get("kind", "")
    name = f"{kind}/{thing.get('metadata', {}).get('name')}"
    model = model_name(version, kind)
    if model is None:
        return [f"{name}: there is no {kind} in {version}"]
    return [f"{name} {place.lstrip('.')}: {what}" for place, what in check(thing, model, "")]


def model_name(version: str, kind: str) -> str | None:
    """The class of the objects of a kind, if the API's version has that kind."""
    group, _, number = SAME_FIELDS.get(version, version).rpartition("/")
    number = number.capitalize()
    api = getattr(kubernetes.client, f"{(group or 'core').split('.')[0].capitalize()}{number}Api", None)
    words = re.sub(r"(?<!^)(?=[A-Z])", "_", kind).lower()
    if not any(hasattr(api, f"create_{scope}{words}") for scope in ("", "namespaced_")):
        return None
    return f"{number}{kind}"


def check(value: Any, kind: str, place: str) -> Iterator[tuple[str, str]]:
    """Places and problems of a value that should be of a kind, as the client's classes write it: list[V1Container]."""
    if kind == "object":  # a number or a text
        return
    if kind in PLAIN:
        if type(value) not in PLAIN[kind]:
            yield place, f"is {value!r}, not of type {kind}"
    elif kind.startswith("list["):
        if not isinstance(value, list):
            yield place, f"is {value!r}, not a list"
            return
        for index, item in enumerate(value):
            yield from check(item, kind[len("list[") : -1], f"{place}[{index}]")
    elif not isinstance(value, dict):
        yield place, f"is {value!r}, not a mapping"
    elif kind.startswith("dict("):
        for key, item in value.items():
            yield from check(item, kind[len("dict(str, ") : -1], f"{place}.{key}")
    else:
        yield from check_fields(value, getattr(kubernetes.client, kind), place)


def check_fields(value: Object, model: Any, place: str) -> Iterator[tuple[str, str]]:
    attributes = {field: attribute for attribute, field in model.attribute_map.items()}
    for field in value.keys() - attributes.keys():
        yield f"{place}.{field}", "unknown field"
    for field, attribute in attributes.items():
        if field in value:
            yield from check(value[field], model.openapi_types[attribute], f"{place}.{field}")
        elif is_required(model, attribute):
            yield f"{place}.{field}", "missing"


def is_required(model: Any, attribute: str) -> bool:
    """Whether the class refuses an object without it."""
    bare = model.__new__(model)
    bare.local_vars_configuration = Configuration()
    try:
        setattr(bare, attribute, None)
    except ValueError:
        return True
    return False
