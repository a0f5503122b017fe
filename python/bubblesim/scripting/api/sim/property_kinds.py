# SPDX-License-Identifier: BSD-3-Clause
"""What a property is: how it is read and set, which objects have it, and the types of values."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from bubblesim.scripting.api.sim.constants import SimConstants as Sim

Get = Callable[[Any, int], Any]  # of the module and a handle
Set = Callable[[Any, int, Any], object]


@dataclass(frozen=True)
class Property:
    """A property of objects."""

    get: Get
    set: Set | None = None
    types: tuple[int, ...] = ()
    """Types of objects that have it; empty for all."""
    leads_to_objects: bool = False
    """Its values are handles."""


_NAMES = {
    Sim.propertytype_bool: "bool",
    Sim.propertytype_int: "int",
    Sim.propertytype_float: "float",
    Sim.propertytype_string: "string",
    Sim.propertytype_buffer: "buffer",
    Sim.propertytype_vector3: "vector3",
    Sim.propertytype_quaternion: "quaternion",
    Sim.propertytype_pose: "pose",
    Sim.propertytype_color: "color",
    Sim.propertytype_floatarray: "floatarray",
    Sim.propertytype_table: "table",
    Sim.propertytype_intarray: "intarray",
    Sim.propertytype_null: "null",
}
_BY_LENGTH = {3: Sim.propertytype_vector3, 4: Sim.propertytype_quaternion, 7: Sim.propertytype_pose}


def int_parameter(parameter: int, types: tuple[int, ...] = ()) -> Property:
    """Return an integer parameter as a property."""
    return Property(
        lambda sim, handle: sim.getObjectInt32Param(handle, parameter),
        lambda sim, handle, value: sim.setObjectInt32Param(handle, parameter, int(value)),
        types,
    )


def float_parameter(parameter: int, types: tuple[int, ...]) -> Property:
    """Return a number parameter as a property."""
    return Property(
        lambda sim, handle: sim.getObjectFloatParam(handle, parameter),
        lambda sim, handle, value: sim.setObjectFloatParam(handle, parameter, float(value)),
        types,
    )


def flag(read: str, bit: int) -> Property:
    """Return a bit of what getObjectProperty, or a function like it, returns."""

    def write(sim: Any, handle: int, value: object) -> None:
        before = getattr(sim, read)(handle)
        getattr(sim, read.replace("get", "set"))(handle, before | bit if value else before & ~bit)

    return Property(lambda sim, handle: bool(getattr(sim, read)(handle) & bit), write)


def type_of(name: str, value: object) -> int:
    """Return sim.propertytype_float ... of a value."""
    if value is None:
        return Sim.propertytype_null
    if isinstance(value, bool):
        return Sim.propertytype_bool
    for kind, number in (
        (int, Sim.propertytype_int),
        (float, Sim.propertytype_float),
        (str, Sim.propertytype_string),
        (bytes, Sim.propertytype_buffer),
        (Mapping, Sim.propertytype_table),
    ):
        if isinstance(value, kind):
            return number
    if not isinstance(value, list | tuple):
        return Sim.propertytype_table
    if name.startswith("color."):
        return Sim.propertytype_color
    if all(isinstance(each, int) for each in value):
        return Sim.propertytype_intarray
    if not all(isinstance(each, int | float) for each in value):
        return Sim.propertytype_table
    return _BY_LENGTH.get(len(value), Sim.propertytype_floatarray)


def type_name(number: int) -> str:
    """Return 'float' ... of a type of properties."""
    return _NAMES.get(number, "")
