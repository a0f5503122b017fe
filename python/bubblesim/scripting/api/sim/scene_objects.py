# SPDX-License-Identifier: BSD-3-Clause
"""Objects of the scene as objects of Python: what `sim.Object` returns in CoppeliaSim's interface 'sim-2'."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bubblesim.scripting.api.kinds import NO_OPTIONS

_METHODS = {
    "dynamicReset": "resetDynamicObject",
    "remove": "removeObject",
    "scaleObject": "scaleObject",
    "getAlias": "getObjectAlias",
}
_OF_SENSORS = {"handleSensor": "handle", "readSensor": "read", "checkSensor": "check", "getImage": "getVisionSensorImg"}


def member(sim: Any, handle: int, name: str) -> tuple[str, Any]:
    """Return what an object has under a name: 'value' and a property, 'object' and a handle, -1 for none, 'objects' and
    handles, 'method' and the name of a function of `sim`, or 'nothing'."""
    found = sim._property(handle, name)
    if found is not None:
        value = found.get(sim, handle)
        if found.leads_to_objects:
            return "objects" if isinstance(value, list) else "object", value
        return "value", value
    if name in _OF_SENSORS and handle >= 0:
        is_camera = sim.getObjectType(handle) == sim.object_visionsensor_type
        part = "VisionSensor" if is_camera else "ProximitySensor"
        method = _OF_SENSORS[name] if name == "getImage" else f"{_OF_SENSORS[name]}{part}"
    elif name[:3] in ("get", "set") and hasattr(type(sim), f"{name[:3]}Object{name[3:]}"):
        method = f"{name[:3]}Object{name[3:]}"
    else:
        method = _METHODS.get(name, name)
    return ("method", method) if hasattr(type(sim), method) else ("nothing", None)


class SceneObject:
    """Its properties are attributes (see sim.getProperty), and the functions of `sim` whose first argument is a handle
    are its methods: ``joint.getPosition()`` is sim.getObjectPosition. It can be passed in place of its handle."""

    __slots__ = ("_handle", "_sim")

    def __init__(self, sim: Any, handle: int) -> None:
        """Stand for an object of the module's scene; sim.handle_scene is the scene itself."""
        object.__setattr__(self, "_sim", sim)
        object.__setattr__(self, "_handle", handle)

    def __index__(self) -> int:
        """Return its handle."""
        handle: int = self._handle
        return handle

    def __eq__(self, other: object) -> bool:
        """Return whether it is the same object."""
        return isinstance(other, SceneObject) and other._handle == self._handle

    def __hash__(self) -> int:
        """Return a number that equal objects share."""
        return hash(self._handle)

    def __repr__(self) -> str:
        """Return its path."""
        return "sim.scene" if self._handle < 0 else f"sim.Object('{self._sim.getObjectAlias(self._handle, 2)}')"

    def __getattr__(self, name: str) -> Any:
        """Return a property, or a method."""
        if name.startswith("_"):
            raise AttributeError(name)
        if name == "getObject":
            return self._get_object
        kind, value = member(self._sim, self._handle, name)
        if kind == "nothing":
            raise AttributeError(f"{self!r} has neither a property nor a method '{name}'")
        if kind == "method":
            method = getattr(self._sim, value)
            return lambda *arguments: method(self._handle, *arguments)
        if kind == "objects":
            return [SceneObject(self._sim, each) for each in value]
        if kind == "object":
            return SceneObject(self._sim, value) if value >= 0 else None
        return value

    def __setattr__(self, name: str, value: Any) -> None:
        """Set a property."""
        self._sim.setProperty(self._handle, name, int(value) if isinstance(value, SceneObject) else value)

    def _get_object(self, path: str, options: Mapping[str, Any] = NO_OPTIONS) -> SceneObject | None:
        """Return an object by a path that begins here; None without one, if ``noError`` is set."""
        handle = self._sim.getObject(path, {**options, "proxy": self._handle} if self._handle >= 0 else options)
        return SceneObject(self._sim, handle) if handle >= 0 else None
