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
    """A function of a module with its documentation, read when it is asked for."""

    name: str
    function: Callable[..., Any]
    group: type
    """The class that defines the function; its group in the reference."""

    @property
    def signature(self) -> inspect.Signature:
        """Return the signature without self."""
        return signature_of(self.function)

    @property
    def doc(self) -> str:
        """Return the docstring without its indentation."""
        return inspect.getdoc(self.function) or ""

    @property
    def for_remote_only(self) -> bool:
        """Return whether callers other than remote clients get an error."""
        return hasattr(self.function, "for_remote_only")

    @property
    def waits(self) -> bool:
        """Return whether it takes several steps."""
        return hasattr(self.function, "waits")

    @property
    def differs(self) -> str:
        """Return how it differs from CoppeliaSim's function."""
        return difference(self.function)


class _CheckedAtFirstUse:
    """A function that is replaced by its checked one as soon as it is looked up.

    To read the annotations of all functions takes a quarter of the time in which the node starts; a script uses few.
    """

    def __init__(self, module: type, module_name: str, name: str, function: Callable[..., Any]) -> None:
        self.function = function
        self._module = module
        self._name = name
        self._full_name = f"{module_name}.{name}"

    def __get__(self, instance: object | None, owner: type) -> Callable[..., Any]:
        call = checked(self._full_name, self.function)
        setattr(self._module, self._name, call)
        return cast(Callable[..., Any], call.__get__(instance, owner))


def script_module(name: str) -> Callable[[Module], Module]:
    """Register a class as the module ``name`` of scripts: its public methods check their arguments."""

    def register(module: Module) -> Module:
        for function_name, function in _public_methods(module):
            setattr(module, function_name, _CheckedAtFirstUse(module, name, function_name, function))
        setattr(module, "__getattr__", _other_names(name, module))  # noqa: B010  # or mypy would take any name of it
        MODULES[name] = module
        return module

    return register


def variant_of_module(name: str) -> Callable[[Module], Module]:
    """Let the functions that a subclass of a module defines anew check their arguments, too."""

    def complete(module: Module) -> Module:
        for function_name, function in _public_methods(module):
            if function_name in vars(module):
                setattr(module, function_name, _CheckedAtFirstUse(module, name, function_name, function))
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
        found.append(ScriptFunction(name, function, group))
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
    """Return the functions of a class and its bases by name, unchecked as long as they are not in use."""
    members = {name: member for base in reversed(module.__mro__) for name, member in vars(base).items()}
    found: list[tuple[str, Callable[..., Any]]] = []
    for name in sorted(each for each in members if not each.startswith("_")):
        member = members[name]
        function = member.function if isinstance(member, _CheckedAtFirstUse) else member
        if inspect.isfunction(function):
            found.append((name, function))
    return found
