"""The typed stub of the native module says what the module has: names, parameters, members."""

from __future__ import annotations

import ast
import inspect
import re
from pathlib import Path

import pfgeom
import pytest
from pfgeom import _core

STUB = ast.parse(Path(pfgeom.__file__).with_name("_core.pyi").read_text())
CLASSES = {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}


def stub_functions(body) -> dict[str, list[str]]:
    """Name -> parameters, without properties."""
    functions = [node for node in body if isinstance(node, ast.FunctionDef) and not node.decorator_list]
    return {node.name: [argument.arg for argument in node.args.args] for node in functions}


def stub_properties(body) -> set[str]:
    return {node.name for node in body if isinstance(node, ast.FunctionDef) and node.decorator_list}


def native_parameters(function) -> list[str]:
    """Of pybind11's first docstring line: `name(a: type, b: type[x, y]) -> type`."""
    signature = inspect.getdoc(function).splitlines()[0]
    inside = re.search(r"\((.*)\)\s*->", signature).group(1)
    while (flat := re.sub(r"\[[^\[\]]*\]|\([^()]*\)", "", inside)) != inside:
        inside = flat
    return [part.split(":")[0].split("=")[0].strip() for part in inside.split(",") if part.strip()]


def native_members(owner) -> dict[str, object]:
    return {name: member for name, member in vars(owner).items() if not name.startswith("_")}


def test_module_names():
    stub = set(CLASSES) | set(stub_functions(STUB.body))
    assert stub == set(native_members(_core))


@pytest.mark.parametrize("name", stub_functions(STUB.body))
def test_functions(name):
    assert stub_functions(STUB.body)[name] == native_parameters(getattr(_core, name))


@pytest.mark.parametrize("name", CLASSES)
def test_classes(name):
    members = native_members(getattr(_core, name))
    methods = stub_functions(CLASSES[name].body)
    methods.pop("__init__", None)
    assert set(methods) | stub_properties(CLASSES[name].body) == set(members)
    assert stub_properties(CLASSES[name].body) == {n for n, m in members.items() if isinstance(m, property)}
    for method, parameters in methods.items():
        assert parameters == native_parameters(members[method])


def test_public_names():
    assert all(hasattr(pfgeom, name) for name in pfgeom.__all__)
    assert pfgeom.__all__ == sorted(pfgeom.__all__)
    assert Path(pfgeom.__file__).with_name("py.typed").exists()
    for name in pfgeom.__all__:
        value = getattr(pfgeom, name)
        assert not (inspect.isclass(value) or inspect.isfunction(value)) or inspect.getdoc(value)
