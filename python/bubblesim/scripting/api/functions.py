# SPDX-License-Identifier: BSD-3-Clause
"""The functions for scripts: methods of the module classes, with arguments checked by their annotations.

A module (`sim`, `simROS`) is a class; each public method is a function of it. Annotations define the arguments, the
docstring is the documentation. Lua, the reference pages and `help` use them.
"""

from __future__ import annotations

import functools
import inspect
import math
import operator
import typing
from collections.abc import Callable, Sized
from dataclasses import dataclass
from typing import Any, SupportsIndex, TypeVar, cast

from bubblesim.scene_state.handle_error import HandleError
from bubblesim.scripting.api.kinds import HANDLE, PLAIN, Kind, MismatchError, shown
from bubblesim.scripting.api.missing_names import explain
from bubblesim.scripting.threads.script_thread import by_ident, current

Module = TypeVar("Module", bound=type)
Function = TypeVar("Function", bound=Callable[..., Any])


MODULES: dict[str, type] = {}  # by their names in scripts
_OMITTED = object()


@dataclass(frozen=True)
class ScriptFunction:
    """A function of a module with its documentation."""

    name: str
    signature: inspect.Signature  # without self
    doc: str
    group: type  # the class that defines the function; its group in the reference
    for_remote_only: bool  # the other callers get an error


class ArgumentError(TypeError):
    """Invalid arguments; the text names function, argument, expected and found values."""


def script_module(name: str) -> Callable[[Module], Module]:
    """Register a class as the module ``name`` of scripts: its public methods check their arguments."""

    def register(module: Module) -> Module:
        for function_name, function in _public_methods(module):
            setattr(module, function_name, _checked(f"{name}.{function_name}", function))
        setattr(module, "__getattr__", _no_such(name, module))  # noqa: B010  # or mypy would take any name of it
        MODULES[name] = module
        return module

    return register


def variant_of_module(name: str) -> Callable[[Module], Module]:
    """Let the functions that a subclass of a module defines anew check their arguments, too."""

    def complete(module: Module) -> Module:
        for function_name, function in _public_methods(module):
            if function_name in vars(module):
                setattr(module, function_name, _checked(f"{name}.{function_name}", function))
        return module

    return complete


def value_first(function: Function) -> Function:
    """Let a function (handle, value, reference) also accept (handle, reference, value), as in older scripts."""

    def reorder(arguments: tuple[Any, ...]) -> tuple[Any, ...]:
        if len(arguments) == 3 and isinstance(arguments[1], SupportsIndex) and not isinstance(arguments[1], Sized):
            return arguments[0], arguments[2], arguments[1]
        return arguments

    function.reorder = reorder  # type: ignore[attr-defined]
    return function


def any_time(function: Function) -> Function:
    """Let a script's thread call a function also outside of its turns."""
    function.any_time = True  # type: ignore[attr-defined]
    return function


def for_remote_only(function: Function) -> Function:
    """Mark a function that only remote clients may call: a child script runs inside of what it would change."""

    @functools.wraps(function)
    def call(self: Any, *arguments: Any) -> Any:
        if not self._caller.is_remote:
            raise RuntimeError(f"sim.{function.__name__} is for remote clients; a child script cannot call it")
        return function(self, *arguments)

    call.for_remote_only = True  # type: ignore[attr-defined]
    return cast(Function, call)


def checked_on_failure(function: Function) -> Function:
    """Check the arguments only if the call raises a TypeError: for functions with critical run time."""
    function.checked_on_failure = True  # type: ignore[attr-defined]
    return function


def functions(module: type) -> list[ScriptFunction]:
    """Return all functions of a module, by name."""
    found = []
    for name, function in _public_methods(module):
        group = next(base for base in reversed(module.__mro__) if name in vars(base))
        doc = inspect.getdoc(function) or ""
        found.append(ScriptFunction(name, _signature(function), doc, group, hasattr(function, "for_remote_only")))
    return found


def kinds_of(module: type, function: str) -> dict[str, Kind | None]:
    """Return the kinds of a function's parameters by name; None for any value."""
    hints = typing.get_type_hints(getattr(module, function), include_extras=True)
    return {name: _kind(hint) for name, hint in hints.items() if name != "return"}


def _no_such(name: str, module: type) -> Callable[[object, str], Any]:
    """Return a __getattr__ that reports unknown names of a module."""

    def refuse(self: object, wanted: str) -> Any:
        raise AttributeError(explain(name, wanted, {name: module, **MODULES}))

    return refuse


def _public_methods(module: type) -> list[tuple[str, Callable[..., Any]]]:
    members = inspect.getmembers(module, inspect.isfunction)
    return [(name, function) for name, function in members if not name.startswith("_")]


def _signature(function: Callable[..., Any]) -> inspect.Signature:
    signature = inspect.signature(function)
    return signature.replace(parameters=list(signature.parameters.values())[1:])


def _kind(hint: Any) -> Kind | None:
    """Return the kind of a parameter; None for any value."""
    for extra in getattr(hint, "__metadata__", ()):
        if isinstance(extra, Kind):
            return extra
    return PLAIN.get(hint)


def _checked(full_name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    signature = _signature(function)
    hints = typing.get_type_hints(function, include_extras=True)
    kinds = [_kind(hints.get(parameter)) for parameter in signature.parameters]
    converters = [kind.convert if kind else _unchanged for kind in kinds]
    reorder = getattr(function, "reorder", None)
    at_any_time = hasattr(function, "any_time")
    variadic = any(p.kind is inspect.Parameter.VAR_POSITIONAL for p in signature.parameters.values())
    fixed = len(converters) - variadic
    most = math.inf if variadic else fixed
    least = sum(p.default is inspect.Parameter.empty for p in signature.parameters.values()) - variadic

    @functools.wraps(function)
    def call_first(*arguments: Any, **named: Any) -> Any:  # including self, which is faster
        if named:
            arguments = (arguments[0], *_bound(full_name, signature, arguments[1:], named))
        try:
            if by_ident and (thread := current()):
                with thread.turn():
                    return function(*arguments)
            return function(*arguments)
        except TypeError:
            arguments = _bound(full_name, signature, arguments[1:], {})
            if not _fit(kinds, arguments):
                raise _argument_error(full_name, signature, kinds, arguments) from None
            raise

    if getattr(function, "checked_on_failure", False):
        return call_first

    def converted(arguments: tuple[Any, ...], named: dict[str, Any]) -> tuple[Any, ...]:
        if reorder is not None:
            arguments = reorder(arguments)
        if named or not least <= len(arguments) <= most:
            arguments = _bound(full_name, signature, arguments, named)
        try:
            taken = tuple(map(operator.call, converters[:fixed], arguments))  # stops where defaults begin
            return taken + arguments[fixed:]
        except (TypeError, ValueError, OverflowError):
            raise _argument_error(full_name, signature, kinds, arguments) from None

    plain = _plain_types(kinds[:fixed], least)

    def call(self: Any, /, *arguments: Any, **named: Any) -> Any:
        if named or tuple(map(type, arguments)) not in plain:
            arguments = converted(arguments, named)
        try:
            if by_ident and not at_any_time and (thread := current()):
                with thread.turn():
                    return function(self, *arguments)
            return function(self, *arguments)
        except HandleError as error:
            raise _located(full_name, signature, kinds, arguments, error) from None

    may_be_alone = least <= 1
    may_be_two = least <= 2
    first_type, second_type = ([kind.plain if kind else None for kind in kinds[:fixed]] + [None, None])[:2]

    @functools.wraps(function)
    def call_short(self: Any, first: Any = _OMITTED, second: Any = _OMITTED, /, *more: Any, **named: Any) -> Any:
        # One or two arguments without conversions, from the simulation's thread: a third of the time of a general call.
        try:
            if type(first) is first_type and not by_ident and not more and not named:
                if type(second) is second_type and may_be_two:
                    return function(self, first, second)
                if second is _OMITTED and may_be_alone:
                    return function(self, first)
        except HandleError as error:
            arguments = (first,) if second is _OMITTED else (first, second)
            raise _located(full_name, signature, kinds, arguments, error) from None
        if second is not _OMITTED:
            return call(self, first, second, *more, **named)
        return call(self, **named) if first is _OMITTED else call(self, first, **named)

    @functools.wraps(function)
    def call_without(self: Any, /, *arguments: Any, **named: Any) -> Any:
        if arguments or named or by_ident:
            return call(self, *arguments, **named)
        return function(self)

    if not kinds:
        return call_without
    return call_short if first_type is not None else functools.wraps(function)(call)


def _plain_types(kinds: list[Kind | None], least: int) -> set[tuple[type, ...]]:
    """Return the argument types, of at least ``least`` arguments, that need no conversion: the common case."""
    types: list[type] = []
    for kind in kinds:
        if kind is None or kind.plain is None:
            break
        types.append(kind.plain)
    return {tuple(types[:count]) for count in range(least, len(types) + 1)}


def _fit(kinds: list[Kind | None], arguments: tuple[Any, ...]) -> bool:
    try:
        for kind, argument in zip(kinds, arguments):  # noqa: B905  # defaults may be left out
            if kind is not None:
                kind.convert(argument)
    except (TypeError, ValueError, OverflowError):
        return False
    return True


def _unchanged(value: Any) -> Any:
    return value


def _bound(
    full_name: str, signature: inspect.Signature, arguments: tuple[Any, ...], named: dict[str, Any]
) -> tuple[Any, ...]:
    """Return the arguments by position."""
    try:
        bound = signature.bind(*arguments, **named)
    except TypeError as error:
        names = ", ".join(str(p).partition(":")[0].partition("=")[0].strip() for p in signature.parameters.values())
        raise ArgumentError(f"{full_name}({names}): {error}") from None
    if named:  # arguments omitted in between
        bound.apply_defaults()
    return bound.args


def _located(
    full_name: str,
    signature: inspect.Signature,
    kinds: list[Kind | None],
    arguments: tuple[Any, ...],
    error: HandleError,
) -> HandleError:
    """Return the error with the called function and the invalid argument."""
    for number, (name, kind, value) in enumerate(zip(signature.parameters, kinds, arguments), start=1):  # noqa: B905
        if kind is HANDLE and value == error.handle:
            return HandleError(error.handle, f"{full_name}: argument {number}, {name}: ")
    return HandleError(error.handle, f"{full_name}: ")


def _argument_error(
    full_name: str, signature: inspect.Signature, kinds: list[Kind | None], arguments: tuple[Any, ...]
) -> ArgumentError:
    for number, (name, kind, value) in enumerate(zip(signature.parameters, kinds, arguments), start=1):  # noqa: B905
        if kind is None:
            continue
        try:
            kind.convert(value)
        except (TypeError, ValueError, OverflowError) as error:
            found = str(error) if isinstance(error, MismatchError) else f"found {shown(value)}"
            return ArgumentError(f"{full_name}: argument {number}, {name}: expected {kind.words}, {found}")
    raise AssertionError("all arguments are valid")
