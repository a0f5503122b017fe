# SPDX-License-Identifier: BSD-3-Clause
"""Loads the definitions of ROS 2's types with their nested types.

ROS 2 is not installed. Most of its types have the fields of ROS 1; the definitions of the others are in ``ros2/``,
those of Humble in ``ros2_before_iron/``.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from bubblesim.messages.packages import Definition, PackageIndex
from bubblesim.messages.ros2_definitions import DefinitionError, FieldType, Ros2Message, read_parts
from bubblesim.messages.ros2_hashes import message_hash, service_hash
from bubblesim.messages.specs import SpecError

_ONLY_ROS1 = {"std_msgs/Time", "std_msgs/Duration", "rosgraph_msgs/Log", "rosgraph_msgs/TopicStatistics"}
_ACTION_PARTS = ("Action", "ActionGoal", "ActionResult", "ActionFeedback", "Goal", "Result", "Feedback")


def own_definitions(*, before_iron: bool) -> PackageIndex:
    """Return the index of the types that ROS 1 does not have, or has with other fields.

    before_iron: as in the distributions of ROS 2 before Iron.
    """
    index = definitions_before_iron() if before_iron else PackageIndex()
    index.add_share(Path(__file__).parent / "ros2")
    return index


def definitions_before_iron() -> PackageIndex:
    """Return the index of the types that had other fields before Iron."""
    index = PackageIndex()
    index.add_share(Path(__file__).parent / "ros2_before_iron")
    return index


def without_ros1_only(names: Iterable[str]) -> list[str]:
    """Remove the messages that ROS 2 does not have: some old types, and the parts of ROS 1's actions."""
    listed = list(names)
    actions = {name.removesuffix("Action") for name in listed if name.endswith("Action")}
    parts = {f"{action}{part}" for action in actions for part in _ACTION_PARTS}
    return [name for name in listed if name not in _ONLY_ROS1 | parts]


@dataclass
class Ros2Specs:
    """The loaded types."""

    index: PackageIndex  # of ROS 1's definitions
    own: PackageIndex  # of own_definitions()
    messages: dict[str, Ros2Message] = field(default_factory=dict)  # by name, after their nested types
    services: dict[str, tuple[Ros2Message, Ros2Message]] = field(default_factory=dict)  # request, response
    files: set[Path] = field(default_factory=set)

    def load_own(self) -> None:
        """Load the types that ROS 1 does not have."""
        for kind in ("msg", "srv"):
            for name in self.own.names(kind):
                self.load(name, kind)

    def find(self, name: str, kind: str) -> Definition | None:
        """Return the definition of `package/Type`; kind is "msg" or "srv"."""
        if name in _ONLY_ROS1:
            return None
        return self.own.find(name, kind) or self.index.find(name, kind)

    def load(self, name: str, kind: str) -> Path:
        """Load one message ("msg") or service ("srv"); return the file that defines it."""
        definition = self.find(name, kind)
        if definition is None:
            raise SpecError(f"{name} has no definition for ROS 2")
        known = self.messages if kind == "msg" else self.services
        if name not in known:
            parts = _read(definition, name, kind)
            for part in parts:
                self._load_nested(part, definition, (name,))
            if kind == "msg":
                self.messages[name] = parts[0]
            else:
                self.services[name] = (parts[0], parts[1])
            self.files.add(definition.file)
        return definition.file

    def load_action(self, name: str) -> str:
        """Load the parts of an action `package/Type`; return the beginning of their names, `package/action/Type`."""
        base = name.replace("/", "/action/")
        goal, result, feedback = parts = self._parts_of_action(name, base)
        for part in parts:
            self.messages[part.name] = part
        for needed in ("unique_identifier_msgs/UUID", "builtin_interfaces/Time"):
            self.load(needed, "msg")
        goal_id = ("goal_id", FieldType("unique_identifier_msgs/UUID"))
        stamp = ("stamp", FieldType("builtin_interfaces/Time"))

        def made(ending: str, *fields: tuple[str, FieldType]) -> Ros2Message:
            return Ros2Message(f"{base}_{ending}", "action", list(fields))

        message = made("FeedbackMessage", goal_id, ("feedback", FieldType(feedback.name)))
        self.messages[message.name] = message
        self.services[f"{base}_SendGoal"] = (
            made("SendGoal_Request", goal_id, ("goal", FieldType(goal.name))),
            made("SendGoal_Response", ("accepted", FieldType("bool")), stamp),
        )
        self.services[f"{base}_GetResult"] = (
            made("GetResult_Request", goal_id),
            made("GetResult_Response", ("status", FieldType("int8")), ("result", FieldType(result.name))),
        )
        return base

    def _parts_of_action(self, name: str, base: str) -> list[Ros2Message]:
        """Return goal, result and feedback, from the .action file or from the messages that ROS 1 makes of it."""
        definition = self.index.find(name, "action")
        if definition is not None:
            parts = _read(definition, base, "action")
            for part in parts:
                self._load_nested(part, definition, (name,))
            self.files.add(definition.file)
            return parts
        parts = []
        for ending in ("Goal", "Result", "Feedback"):
            found = self.index.find(f"{name}{ending}", "msg")
            if found is None:
                raise SpecError(f"{name} has no definition: expected package/Name such as test_msgs/Fibonacci")
            (message,) = _read(found, f"{name}{ending}", "msg")
            part = Ros2Message(f"{base}_{ending}", "action", message.fields, message.constants, message.defaults)
            self._load_nested(part, found, (name,))
            parts.append(part)
        return parts

    def message_hash(self, message: Ros2Message) -> str:
        """Return the hash of a loaded message, or of a half of a service."""
        return message_hash(message, self.messages.__getitem__)

    def service_hash(self, name: str) -> str:
        """Return the hash of a loaded service."""
        if "builtin_interfaces/Time" not in self.messages:
            self.load("builtin_interfaces/Time", "msg")  # of the service's events
        return service_hash(name, *self.services[name], self.messages.__getitem__)

    def full_text(self, message: Ros2Message) -> str:
        """Return the definition of a loaded message, followed by those of its nested types."""
        strings = [message.text]
        seen: set[str] = set()
        waiting = [message]
        while waiting:
            for _, kind in waiting.pop().fields:
                if not kind.is_builtin and kind.base not in seen:
                    seen.add(kind.base)
                    nested = self.messages[kind.base]
                    strings.append(f"MSG: {nested.full_name}\n{nested.text}")
                    waiting.append(nested)
        return ("=" * 80 + "\n").join(strings)

    def _load_nested(self, message: Ros2Message, definition: Definition, inside: tuple[str, ...]) -> None:
        for label, kind in message.fields:
            if kind.base == "wstring":
                raise SpecError(f"{message.name}: {label} is a wstring, which is not supported ({definition.file})")
            if kind.is_builtin or kind.base in self.messages:
                continue
            if kind.base in inside:
                raise SpecError(f"{inside[0]} contains itself: {' > '.join([*inside, kind.base])}")
            found = self.find(kind.base, "msg")
            if found is None:
                raise SpecError(f"{kind.base}, used in {' > '.join(inside)} ({definition.file}), is not in ROS 2")
            (nested,) = _read(found, kind.base, "msg")
            self._load_nested(nested, found, (*inside, kind.base))
            self.messages[kind.base] = nested
            self.files.add(found.file)


def _read(definition: Definition, name: str, kind: str) -> list[Ros2Message]:
    try:
        return read_parts(definition.text, name, kind)
    except DefinitionError as error:
        raise SpecError(f"{name}: {definition.file}: {error}") from error
