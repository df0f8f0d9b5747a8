"""The type stubs have what the module has."""

import ast
import inspect
from pathlib import Path

import pytest

import motion_rtl as mr
from motion_rtl import _motion_rtl

STUBS = ast.parse(Path(mr.__file__).with_name("_motion_rtl.pyi").read_text())
CLASSES = {node.name: node for node in STUBS.body if isinstance(node, ast.ClassDef)}
#: Methods that every class has, and those of a mapping that are written without names.
SPECIAL = {"__doc__", "__module__", "__repr__", "__str__", "__new__", "__delitem__"}


def test_every_class_and_function_has_a_stub():
    functions = {node.name for node in STUBS.body if isinstance(node, ast.FunctionDef)}
    names = {name for name in vars(_motion_rtl) if not name.startswith("__")}
    assert names == functions | set(CLASSES)


@pytest.mark.parametrize("name", CLASSES)
def test_every_method_has_a_stub(name):
    stubs = {node.name for node in CLASSES[name].body if isinstance(node, ast.FunctionDef)}
    assert set(vars(getattr(_motion_rtl, name))) - SPECIAL == stubs - SPECIAL


def parameters(arguments):
    named = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
    return [argument.arg for argument in named if argument.arg not in ("self", "cls")]


def stubbed():
    for name, node in CLASSES.items():
        for method in node.body:
            if not method.decorator_list and not method.name.startswith("__"):
                yield pytest.param(
                    getattr(getattr(_motion_rtl, name), method.name), method, id=method.name
                )
    for node in STUBS.body:
        if isinstance(node, ast.FunctionDef):
            yield pytest.param(getattr(_motion_rtl, node.name), node, id=node.name)


@pytest.mark.parametrize(("function", "stub"), list(stubbed()))
def test_parameters_are_those_of_the_stubs(function, stub):
    names = [name for name in inspect.signature(function).parameters if name != "self"]
    assert names == parameters(stub.args)


@pytest.mark.parametrize("name", [name for name in mr.__all__ if name != "__version__"])
def test_every_public_name_is_documented(name):
    public = getattr(mr, name)
    assert inspect.getdoc(public)
    for key, member in vars(public).items() if inspect.isclass(public) else ():
        if not key.startswith("_") and not isinstance(member, str):
            assert inspect.getdoc(member), f"{name}.{key}"
