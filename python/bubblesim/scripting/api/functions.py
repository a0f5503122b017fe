# SPDX-License-Identifier: BSD-3-Clause
"""The functions for scripts: methods of the module classes, with arguments checked by their annotations.

A module (`sim`, `simROS`) is a class; each public method is a function of it. Annotations define the arguments, the
docstring is the documentation. Lua, the reference pages and `help` use them.
"""

from __future__ import annotations

import functools
import inspect
import typing
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar, cast

from bubblesim.messages.names import unknown_attribute
from bubblesim.scripting.api.checked_calls import checked, kind_of, signature_of
from bubblesim.scripting.api.differences import difference
from bubblesim.scripting.api.kinds import Kind
from bubblesim.scripting.api.missing_names import explain
from bubblesim.scripting.api.old_names import note_old_name, present_name
from bubblesim.scripting.caller import Caller

Module = TypeVar("Module", bound=type)
Function = TypeVar("Function", bound=Callable[..., Any])

MODULES: dict[str, type] = {}  # by their names in scripts


@dataclass(frozen=True)
class ScriptFunction:
    """A function of a module with its documentation."""

    name: str
    signature: inspect.Signature  # without self
    doc: str
    group: type  # the class that defines the function; its group in the reference
    for_remote_only: bool  # the other callers get an error
    waits: bool = False  # it takes several steps
    differs: str = ""  # how, from CoppeliaSim's function


def script_module(name: str) -> Callable[[Module], Module]:
    """Register a class as the module ``name`` of scripts: its public methods check their arguments."""

    def register(module: Module) -> Module:
        for function_name, function in _public_methods(module):
            setattr(module, function_name, checked(f"{name}.{function_name}", function))
        setattr(module, "__getattr__", _other_names(name, module))  # noqa: B010  # or mypy would take any name of it
        MODULES[name] = module
        return module

    return register


def variant_of_module(name: str) -> Callable[[Module], Module]:
    """Let the functions that a subclass of a module defines anew check their arguments, too."""

    def complete(module: Module) -> Module:
        for function_name, function in _public_methods(module):
            if function_name in vars(module):
                setattr(module, function_name, checked(f"{name}.{function_name}", function))
        return module

    return complete


def for_remote_only(function: Function) -> Function:
    """Mark a function that only remote clients may call: a child script runs inside of what it would change."""

    @functools.wraps(function)
    def call(self: Any, *arguments: Any) -> Any:
        if not self._caller.is_remote:
            raise RuntimeError(f"sim.{function.__name__} is for remote clients; a child script cannot call it")
        return function(self, *arguments)

    call.for_remote_only = True  # type: ignore[attr-defined]
    return cast(Function, call)


def functions(module: type) -> list[ScriptFunction]:
    """Return all functions of a module, by name."""
    found = []
    for name, function in _public_methods(module):
        group = next(base for base in reversed(module.__mro__) if name in vars(base))
        doc = inspect.getdoc(function) or ""
        marks = hasattr(function, "for_remote_only"), hasattr(function, "waits")
        found.append(ScriptFunction(name, signature_of(function), doc, group, *marks, difference(function)))
    return found


def caller_of(module: Any) -> Caller:
    """Return who calls the functions of an instance of a module."""
    caller: Caller = module._caller
    return caller


def kinds_of(module: type, function: str) -> dict[str, Kind | None]:
    """Return the kinds of a function's parameters by name; None for any value."""
    hints = typing.get_type_hints(getattr(module, function), include_extras=True)
    return {name: kind_of(hint) for name, hint in hints.items() if name != "return"}


def _other_names(name: str, module: type) -> Callable[[object, str], Any]:
    """Return a __getattr__ that resolves old names of a module, and reports unknown ones."""

    def resolve(self: Any, wanted: str) -> Any:
        present = present_name(name, wanted)
        if present is None or not hasattr(module, present):
            raise unknown_attribute(explain(name, wanted, {name: module, **MODULES}))
        note_old_name(self._caller, f"{name}.{wanted}", f"{name}.{present}")
        return getattr(self, present)

    return resolve


def _public_methods(module: type) -> list[tuple[str, Callable[..., Any]]]:
    members = inspect.getmembers(module, inspect.isfunction)
    return [(name, function) for name, function in members if not name.startswith("_")]
