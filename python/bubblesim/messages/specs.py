# SPDX-License-Identifier: BSD-3-Clause
"""Loads the definitions of types with their nested types, and reports errors in them."""

from __future__ import annotations

import difflib
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import genmsg  # type: ignore[import-untyped]
import genmsg.gentools  # type: ignore[import-untyped]
import genmsg.msg_loader  # type: ignore[import-untyped]

from bubblesim.messages.kinds import KINDS, is_builtin
from bubblesim.messages.lists import Entry
from bubblesim.messages.names import did_you_mean, nearest_names, split_name
from bubblesim.messages.packages import Definition, PackageIndex


class SpecError(Exception):
    """A type that cannot be used; the text states why and what to do."""


@dataclass
class Specs:
    """genmsg's descriptions of the loaded types."""

    index: PackageIndex
    context: Any = field(default_factory=genmsg.MsgContext.create_default)
    messages: dict[str, Any] = field(default_factory=dict)  # name -> genmsg.MsgSpec, after its nested types
    services: dict[str, Any] = field(default_factory=dict)  # name -> genmsg.SrvSpec
    files: set[Path] = field(default_factory=set)

    def load(self, name: str, kind: str) -> Path:
        """Load one message ("msg") or service ("srv"); return the file that defines it."""
        definition = self.index.find(name, kind)
        if definition is None:
            raise SpecError(self.not_found(name, kind))
        if kind == "msg":
            self._load_message(name, definition, ())
        else:
            self._load_service(name, definition)
        return definition.file

    def md5(self, spec: Any) -> str:
        """Return the checksum of a loaded message or service."""
        return str(genmsg.gentools.compute_md5(self.context, spec))

    def full_text(self, spec: Any) -> str:
        """Return the definition of a loaded message, followed by those of its nested types."""
        return str(genmsg.gentools.compute_full_text(self.context, spec))

    def not_found(self, name: str, kind: str) -> str:
        """Return the error for an unknown type, with similar names."""
        what = "message" if kind == "msg" else "service"
        package, short = split_name(name)
        if self.index.find(name, "srv" if kind == "msg" else "msg"):
            place = "meta/services.txt" if kind == "msg" else "meta/messages.txt"
            return f"{name} is a {'service' if kind == 'msg' else 'message'}: list it in {place}"
        hint = did_you_mean(nearest_names(name, self.index.names(kind)))
        if self.index.has_package(package):
            return f"{package} has no {what} {short}{hint}"
        cure = hint or f"; install ros-{package.replace('_', '-')} or add the package to the workspace"
        return f"package {package} is not found{cure}"

    def _load_message(self, name: str, definition: Definition, inside: tuple[str, ...]) -> None:
        spec = _parse(genmsg.msg_loader.load_msg_from_string, self.context, definition, name)
        self._load_nested(spec, definition, (*inside, name))
        self.messages[name] = spec
        self.files.add(definition.file)

    def _load_service(self, name: str, definition: Definition) -> None:
        spec = _parse(genmsg.msg_loader.load_srv_from_string, self.context, definition, name)
        self._load_nested(spec.request, definition, (name,))
        self._load_nested(spec.response, definition, (name,))
        self.services[name] = spec
        self.files.add(definition.file)

    def _load_nested(self, spec: Any, definition: Definition, inside: tuple[str, ...]) -> None:
        nested = [part.base_type for part in spec.parsed_fields() if not is_builtin(part.base_type)]
        for name in nested:
            if name in inside:
                raise SpecError(f"{inside[0]} contains itself: {' > '.join([*inside, name])}")
            if name in self.messages:
                continue
            found = self.index.find(name, "msg")
            if found is None:
                raise SpecError(self._nested_not_found(name, definition, inside))
            self._load_message(name, found, inside)
        self.context.set_depends(spec.full_name, nested)

    def _nested_not_found(self, name: str, definition: Definition, inside: tuple[str, ...]) -> str:
        place = _place(definition, _line_of_type(definition.text, name))
        package, short = split_name(name)
        near = nearest_names(name, self.index.names("msg"))
        if package == split_name(inside[-1])[0]:  # could be a misspelt builtin type
            near = difflib.get_close_matches(short.lower(), KINDS, n=1) or near
        cure = did_you_mean(near) or "; install its package or add it to the workspace"
        return f"{name}, used in {' > '.join(inside)} ({place}), is not found{cure}"


def load_list(load: Callable[[str, str], object], entries: list[Entry], kind: str, problems: list[str]) -> None:
    """Load listed messages ("msg") or services ("srv") with Specs.load or Ros2Specs.load; add errors to `problems`."""
    for entry in entries:
        try:
            load(entry.name, kind)
        except SpecError as error:
            problems.append(f"{entry.place}: {error}")


def _parse(load: Callable[..., Any], context: Any, definition: Definition, name: str) -> Any:
    try:
        return load(context, definition.text, name)
    except (genmsg.InvalidMsgSpec, ValueError) as error:
        bad_lines = _bad_lines(definition.text, name) or [(0, str(error))]
        problems = "\n".join(f"{_place(definition, number)}: {problem}" for number, problem in bad_lines)
        raise SpecError(f"{name}: {problems}") from error


def _bad_lines(text: str, name: str) -> list[tuple[int, str]]:
    """Return numbers and errors of all invalid lines: genmsg stops at the first and does not report its number."""
    problems: list[tuple[int, str]] = []
    good_lines: list[str] = []
    for number, line in enumerate(text.split("\n"), start=1):
        if line.startswith("---"):
            good_lines.clear()  # request and response of a service may have fields of the same name
            continue
        try:
            genmsg.msg_loader.load_msg_from_string(genmsg.MsgContext(), "\n".join([*good_lines, line]), name)
        except (genmsg.InvalidMsgSpec, ValueError) as error:
            problems.append((number, str(error)))
        else:
            good_lines.append(line)
    return problems


def _line_of_type(text: str, name: str) -> int:
    """Return the number of the line that has a field of a message type; 0 if there is none."""
    for number, line in enumerate(text.split("\n"), start=1):
        spelling = line.partition("#")[0].strip().partition(" ")[0].partition("[")[0]
        if spelling and spelling in (name, split_name(name)[1]):
            return number
    return 0


def _place(definition: Definition, number: int) -> str:
    """Return file:line of a definition; only the file for generated files, whose lines differ."""
    is_source = definition.file.suffix in (".msg", ".srv")
    return f"{definition.file}:{number}" if number and is_source else str(definition.file)
