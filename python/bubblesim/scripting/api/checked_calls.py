# SPDX-License-Identifier: BSD-3-Clause
"""Calls of script functions with checked arguments.

Annotations define the kinds of the arguments; they are converted, and an error names function, argument, expected and
found value. Scripts call functions thousands of times in a step, so each function gets the shortest call that fits it.
"""

from __future__ import annotations

import functools
import inspect
import math
import operator
import typing
from collections.abc import Callable, Sized
from typing import Any, SupportsIndex, TypeVar

from bubblesim._core import WrongObject
from bubblesim.scene_state.handle_error import HandleError
from bubblesim.scripting.api.kinds import HANDLE, PLAIN, Kind, MismatchError, shown
from bubblesim.scripting.threads.script_thread import by_ident, current

Function = TypeVar("Function", bound=Callable[..., Any])

_OMITTED = object()


class ArgumentError(TypeError):
    """Invalid arguments; the text names function, argument, expected and found values."""


class SurplusArgumentsError(ArgumentError):
    """More arguments than a function takes; it was not called."""

    def __init__(self, text: str, most: int) -> None:
        """Store the number that it takes."""
        super().__init__(text)
        self.most = most


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


def refusal_warns(function: Function) -> Function:
    """Let a function that changes an object log a warning, once, where physics refuses the change (WrongObject): in
    CoppeliaSim all objects can be changed, and a script goes on."""
    function.refusal_warns = True  # type: ignore[attr-defined]
    return function


def checked_on_failure(function: Function) -> Function:
    """Check the arguments only if the call raises a TypeError: for functions with critical run time."""
    function.checked_on_failure = True  # type: ignore[attr-defined]
    return function


def checked(full_name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a method that checks its arguments and takes the turn of the script's thread that calls it.

    :param full_name: for errors, such as "sim.getObject".
    """
    parameters = Parameters(full_name, function)
    if hasattr(function, "checked_on_failure"):
        return _checked_after_failure(function, parameters)
    call = _converted(function, parameters)
    if not parameters.kinds:
        return _without_arguments(function, call)
    if any(parameters.plain_types[:1]):
        return _with_plain_arguments(function, parameters, call)
    return call


class Parameters:
    """The parameters of a function: conversion of arguments, and errors about them."""

    def __init__(self, full_name: str, function: Callable[..., Any]) -> None:
        """Read the annotations."""
        self.full_name = full_name
        self.signature = signature_of(function)
        hints = typing.get_type_hints(function, include_extras=True)
        self.kinds = [kind_of(hints.get(parameter)) for parameter in self.signature.parameters]
        variadic = any(p.kind is inspect.Parameter.VAR_POSITIONAL for p in self.signature.parameters.values())
        fixed = len(self.kinds) - variadic
        self.plain_types = [kind.plain if kind else None for kind in self.kinds[:fixed]]
        """Of arguments that need no conversion; None if they always do."""
        self.least = sum(p.default is inspect.Parameter.empty for p in self.signature.parameters.values()) - variadic
        self._most = math.inf if variadic else fixed
        self._converters = [kind.convert if kind else _unchanged for kind in self.kinds[:fixed]]
        self._reorder = getattr(function, "reorder", None)
        self._refusal_warns = hasattr(function, "refusal_warns")

    def convert(self, arguments: tuple[Any, ...], named: dict[str, Any]) -> tuple[Any, ...]:
        """Return the arguments by position, converted to their kinds; raise ArgumentError if that is impossible."""
        if self._reorder is not None:
            arguments = self._reorder(arguments)
        if named or not self.least <= len(arguments) <= self._most:
            arguments = self.bind(arguments, named)
        try:
            taken = tuple(map(operator.call, self._converters, arguments))  # stops where defaults begin
            return taken + arguments[len(self._converters) :]
        except (TypeError, ValueError, OverflowError):
            raise self.error(arguments) from None

    def bind(self, arguments: tuple[Any, ...], named: dict[str, Any]) -> tuple[Any, ...]:
        """Return the arguments by position; raise ArgumentError if there are too many or too few."""
        try:
            bound = self.signature.bind(*arguments, **named)
        except TypeError as error:
            parameters = self.signature.parameters.values()
            names = ", ".join(str(each).partition(":")[0].partition("=")[0].strip() for each in parameters)
            text = f"{self.full_name}({names}): {error}"
            if not named and len(arguments) > self._most:
                raise SurplusArgumentsError(text, int(self._most)) from None
            raise ArgumentError(text) from None
        if named:  # arguments omitted in between
            bound.apply_defaults()
        return bound.args

    def fit(self, arguments: tuple[Any, ...]) -> bool:
        """Return whether all arguments can be converted."""
        return self._first_misfit(arguments) is None

    def error(self, arguments: tuple[Any, ...]) -> ArgumentError:
        """Return the error about the first argument that cannot be converted."""
        misfit = self._first_misfit(arguments)
        assert misfit is not None, "all arguments are valid"
        return ArgumentError(f"{self.full_name}: {misfit}")

    def located(self, arguments: tuple[Any, ...], error: HandleError) -> HandleError:
        """Return the error with the called function and the invalid argument."""
        for number, (name, kind, value) in enumerate(self._given(arguments), start=1):
            if kind is HANDLE and value == error.handle:
                return HandleError(error.handle, f"{self.full_name}: argument {number}, {name}: ")
        return HandleError(error.handle, f"{self.full_name}: ")

    def refused(self, module: Any, error: WrongObject) -> None:
        """Log the refusal of a change once, if the function is one of those; raise it otherwise."""
        if not self._refusal_warns:
            raise error
        level = module.verbosity_scriptwarnings | module.verbosity_once
        module.addLog(level, f"{self.full_name} has no effect: {error}")

    def _first_misfit(self, arguments: tuple[Any, ...]) -> str | None:
        for number, (name, kind, value) in enumerate(self._given(arguments), start=1):
            if kind is None:
                continue
            try:
                kind.convert(value)
            except (TypeError, ValueError, OverflowError) as error:
                found = str(error) if isinstance(error, MismatchError) else f"found {shown(value)}"
                if kind is HANDLE and isinstance(value, str):
                    found += f"; sim.getObject('/{value.lstrip('/')}') returns it"
                return f"argument {number}, {name}: expected {kind.words}, {found}"
        return None

    def _given(self, arguments: tuple[Any, ...]) -> zip[tuple[str, Kind | None, Any]]:
        return zip(self.signature.parameters, self.kinds, arguments)  # noqa: B905  # defaults may be left out


def _checked_after_failure(function: Callable[..., Any], parameters: Parameters) -> Callable[..., Any]:
    """Return a call that checks its arguments only when the function raises a TypeError."""

    @functools.wraps(function)
    def call(*arguments: Any, **named: Any) -> Any:  # including self, which is faster
        if named:
            arguments = (arguments[0], *parameters.bind(arguments[1:], named))
        try:
            if by_ident and (thread := current()):
                with thread.turn():
                    return function(*arguments)
            return function(*arguments)
        except TypeError:
            given = parameters.bind(arguments[1:], {})
            if not parameters.fit(given):
                raise parameters.error(given) from None
            raise

    return call


def _converted(function: Callable[..., Any], parameters: Parameters) -> Callable[..., Any]:
    """Return a call that converts its arguments, unless all have types that need no conversion."""
    plain = _plain_calls(parameters)
    convert = parameters.convert
    at_any_time = hasattr(function, "any_time")

    @functools.wraps(function)
    def call(self: Any, /, *arguments: Any, **named: Any) -> Any:
        if named or tuple(map(type, arguments)) not in plain:
            arguments = convert(arguments, named)
        try:
            if by_ident and not at_any_time and (thread := current()):
                with thread.turn():
                    return function(self, *arguments)
            return function(self, *arguments)
        except HandleError as error:
            raise parameters.located(arguments, error) from None
        except WrongObject as error:
            return parameters.refused(self, error)

    return call


def _plain_calls(parameters: Parameters) -> set[tuple[type, ...]]:
    """Return the types of arguments, in all possible numbers, that need no conversion: the common case."""
    types: list[type] = []
    for plain in parameters.plain_types:
        if plain is None:
            break
        types.append(plain)
    return {tuple(types[:count]) for count in range(parameters.least, len(types) + 1)}


def _without_arguments(function: Callable[..., Any], general: Callable[..., Any]) -> Callable[..., Any]:
    """Return the call of a function that has no parameters."""

    @functools.wraps(function)
    def call(self: Any, /, *arguments: Any, **named: Any) -> Any:
        if arguments or named or by_ident:
            return general(self, *arguments, **named)
        return function(self)

    return call


def _with_plain_arguments(
    function: Callable[..., Any], parameters: Parameters, general: Callable[..., Any]
) -> Callable[..., Any]:
    """Return a call that passes one or two arguments on if they need no conversion, in the simulation's thread.

    It takes a third of the time of a general call.
    """
    may_be_alone = parameters.least <= 1
    may_be_two = parameters.least <= 2
    first_type, second_type = [*parameters.plain_types, None][:2]

    @functools.wraps(function)
    def call(self: Any, first: Any = _OMITTED, second: Any = _OMITTED, /, *more: Any, **named: Any) -> Any:
        try:
            if type(first) is first_type and not by_ident and not more and not named:
                if type(second) is second_type and may_be_two:
                    return function(self, first, second)
                if second is _OMITTED and may_be_alone:
                    return function(self, first)
        except HandleError as error:
            arguments = (first,) if second is _OMITTED else (first, second)
            raise parameters.located(arguments, error) from None
        except WrongObject as error:
            return parameters.refused(self, error)
        if second is not _OMITTED:
            return general(self, first, second, *more, **named)
        return general(self, **named) if first is _OMITTED else general(self, first, **named)

    return call


def signature_of(function: Callable[..., Any]) -> inspect.Signature:
    """Return the signature of a method without self."""
    signature = inspect.signature(function)
    return signature.replace(parameters=list(signature.parameters.values())[1:])


def kind_of(hint: Any) -> Kind | None:
    """Return the kind of a parameter; None for any value."""
    for extra in getattr(hint, "__metadata__", ()):
        if isinstance(extra, Kind):
            return extra
    return PLAIN.get(hint)


def _unchanged(value: Any) -> Any:
    return value
