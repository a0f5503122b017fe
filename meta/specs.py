# SPDX-License-Identifier: BSD-3-Clause
"""Loads the listed types with all that they contain, and says what is wrong with the lists."""

from __future__ import annotations

import difflib
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import genmsg  # type: ignore[import-untyped]
import genmsg.msg_loader  # type: ignore[import-untyped]

import rules
from packages import PackageIndex

_NAME = re.compile(r"([a-z][a-z0-9_]*)/(?:(msg|srv)/)?([A-Za-z][A-Za-z0-9_]*)", re.IGNORECASE)


@dataclass(frozen=True)
class Entry:
    """A line of a list that names a type."""

    place: str  # "meta/messages.txt:12"
    name: str  # "geometry_msgs/Twist"


class SpecError(Exception):
    """A listed type that cannot be used; the text says why and what to do."""


def read_list(path: Path, shown_as: str, problems: list[str]) -> list[Entry]:
    """The entries of messages.txt or services.txt; malformed and repeated lines go to `problems`."""
    entries: dict[str, Entry] = {}
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        text = line.partition("#")[0].strip()
        if not text:
            continue
        place = f"{shown_as}:{number}"
        match = _NAME.fullmatch(text)
        if match is None:
            problems.append(f"{place}: '{text}' is no type name, expected package/Type such as geometry_msgs/Twist")
            continue
        entry = Entry(place, f"{match[1]}/{match[3]}")
        if entry.name in entries:
            problems.append(f"{place}: {entry.name} is listed twice, first at {entries[entry.name].place}; remove one")
        else:
            entries[entry.name] = entry
    return list(entries.values())


@dataclass
class Specs:
    """genmsg's description of every needed type; `load` adds to it."""

    index: PackageIndex
    context: Any = field(default_factory=genmsg.MsgContext.create_default)
    messages: dict[str, Any] = field(default_factory=dict)  # name -> genmsg.MsgSpec, nested types too
    services: dict[str, Any] = field(default_factory=dict)  # name -> genmsg.SrvSpec
    files: set[Path] = field(default_factory=set)

    def load(self, entries: list[Entry], kind: str, problems: list[str]) -> None:
        """Loads listed messages ("msg") or services ("srv"); what cannot be loaded goes to `problems`."""
        for entry in entries:
            try:
                if kind == "msg":
                    self._load_message(entry.name, ())
                else:
                    self._load_service(entry.name)
            except SpecError as error:
                problems.append(f"{entry.place}: {error}")

    def _load_message(self, name: str, inside: tuple[str, ...]) -> None:
        if name in inside:
            raise SpecError(f"{name} contains itself: {' > '.join([*inside, name])}")
        if name in self.messages:
            return
        definition = self.index.find(name, "msg")
        if definition is None:
            raise SpecError(self._not_found(name, "msg", inside))
        try:
            spec = genmsg.msg_loader.load_msg_from_string(self.context, definition.text, name)
        except (genmsg.InvalidMsgSpec, ValueError) as error:
            raise SpecError(f"{name}: {definition.file}: {error}") from error
        self._load_nested(spec, (*inside, name))
        self.messages[name] = spec
        self.files.add(definition.file)

    def _load_service(self, name: str) -> None:
        definition = self.index.find(name, "srv")
        if definition is None:
            raise SpecError(self._not_found(name, "srv", ()))
        try:
            spec = genmsg.msg_loader.load_srv_from_string(self.context, definition.text, name)
        except (genmsg.InvalidMsgSpec, ValueError) as error:
            raise SpecError(f"{name}: {definition.file}: {error}") from error
        self._load_nested(spec.request, (name,))
        self._load_nested(spec.response, (name,))
        self.services[name] = spec
        self.files.add(definition.file)

    def _load_nested(self, spec: Any, inside: tuple[str, ...]) -> None:
        nested = [part.base_type for part in spec.parsed_fields() if not rules.is_builtin(part.base_type)]
        for name in nested:
            self._load_message(name, inside)
        self.context.set_depends(spec.full_name, nested)

    def _not_found(self, name: str, kind: str, inside: tuple[str, ...]) -> str:
        what = "message" if kind == "msg" else "service"
        if inside:
            what = f"{name}, which {' > '.join(inside)} contains,"
            return f"{what} is not found; install its package or put it into the workspace"
        package, short = rules.split_name(name)
        other = "srv" if kind == "msg" else "msg"
        if self.index.find(name, other):
            place = "meta/services.txt" if kind == "msg" else "meta/messages.txt"
            return f"{name} is a {'service' if kind == 'msg' else 'message'}: it belongs into {place}"
        hint = nearest_names(name, self.index.names(kind))
        did_you_mean = f"; did you mean {' or '.join(hint)}?" if hint else ""
        if self.index.has_package(package):
            return f"{package} has no {what} {short}{did_you_mean}"
        cure = did_you_mean or f"; install ros-{package.replace('_', '-')} or put the package into the workspace"
        return f"there is no package {package}{cure}"


def nearest_names(name: str, known: list[str]) -> list[str]:
    """At most two known names that a typo may have turned into `name`, best first."""
    package, short = rules.split_name(name)

    def likeness(candidate: str) -> float:
        other_package, other_short = rules.split_name(candidate)
        parts = ((package, other_package), (short, other_short))
        return sum(difflib.SequenceMatcher(None, a.lower(), b.lower()).ratio() for a, b in parts) / 2

    # Package and type are compared apart: a long package name alone must not make two types alike.
    ranked = sorted(((likeness(candidate), candidate) for candidate in known), key=lambda pair: (-pair[0], pair[1]))
    best = [pair for pair in ranked if pair[0] >= 0.75][:2]
    return [candidate for score, candidate in best if score > best[0][0] - 0.05]
