# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for named values shared by all scripts of a scene."""

from __future__ import annotations

from typing import Annotated, Any

from bubblesim._core import read_lidar, reading_time
from bubblesim.scripting.api.kinds import NO_OPTIONS, Handle, Kind, Options, TextOrBytes
from bubblesim.scripting.api.sim.context import ApiContext


def _text_of_signal(value: Any) -> str | bytes:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return f"{value:.14g}" if is_number else value if isinstance(value, str) else bytes(memoryview(value))


SignalText = Annotated[str | bytes, Kind("a string or bytes", _text_of_signal)]
_DATA_PREFIX = "customData."
_PREFIX = "signal."  # of the names in the newer functions: properties of the scene


def require_type(name: str, value: object, wanted: type | tuple[type, ...]) -> None:
    """Raise ValueError unless the value of a property is of a type."""
    if not isinstance(value, wanted):
        raise ValueError(f"the property '{name}' is of type {type(value).__name__}")


class SignalFunctions(ApiContext):
    """Named values, shared by all scripts; strings, numbers and integers have separate namespaces."""

    def setStringSignal(self, name: str, value: SignalText) -> None:
        """Set a string or bytes; a number is written as one, as in Lua."""
        self._set(str, name, value)

    def getStringSignal(self, name: str) -> str | bytes | None:
        """Return the text or bytes last set; None (nil) if there is nothing.

        A lidar with this name as its <bubblesim:signal> sets it with each measurement: x, y, z of all points as packed
        floats, in metres in the lidar's frame.
        """
        return self._get_text(name)

    def clearStringSignal(self, name: str) -> None:
        """Delete a string; a lidar sets its signal again with the next measurement."""
        self._clear(str, name)
        if name and (lidar := self._world.find_signal(name)) >= 0:
            self._caller.shared.cleared_scans[name] = float(reading_time(self._simulation, lidar))

    def appendStringSignal(self, name: str, value: TextOrBytes) -> int:
        """Add a string or bytes to the end of a signal (old name); return 1."""
        before = self._get_text(name)
        if isinstance(value, str) and isinstance(before, str | None):
            self._set(str, name, (before or "") + value)
        else:
            parts = [each.encode() if isinstance(each, str) else bytes(each) for each in (before or b"", value)]
            self._set(str, name, b"".join(parts))
        return 1

    def setBufferSignal(self, name: str, value: TextOrBytes) -> None:
        """Set bytes: a string signal."""
        self._set(str, name, value)

    def getBufferSignal(self, name: str) -> str | bytes | None:
        """Return the bytes of a signal; None (nil) if there are none."""
        return self._get_text(name)

    def clearBufferSignal(self, name: str) -> None:
        """Delete the bytes of a signal."""
        self.clearStringSignal(name)

    def setFloatSignal(self, name: str, value: float) -> None:
        """Set a number."""
        self._set(float, name, value)

    def getFloatSignal(self, name: str) -> float | None:
        """Return the number last set; None (nil) if there is none."""
        value: float | None = self._get(float, name)
        return value

    def clearFloatSignal(self, name: str) -> None:
        """Delete a number."""
        self._clear(float, name)

    def setInt32Signal(self, name: str, value: int) -> None:
        """Set a 32-bit integer."""
        if not -(2**31) <= value < 2**31:
            raise ValueError(f"sim.setInt32Signal: {value} does not fit into 32 bits")
        self._set(int, name, value)

    def getInt32Signal(self, name: str) -> int | None:
        """Return the integer last set; None (nil) if there is none."""
        value: int | None = self._get(int, name)
        return value

    def clearInt32Signal(self, name: str) -> None:
        """Delete an integer."""
        self._clear(int, name)

    def getSignalName(self, index: int, kind: int = 3) -> str | None:
        """Return the name of the signal with an index from 0 among the integers (``kind`` 0), numbers (1) or strings (2
        or 3); None (nil) behind the last one."""
        kinds = {0: int, 1: float, 2: str, 3: str}
        if kind not in kinds:
            raise ValueError(f"{kind} is not a kind of signals: 0 integers, 1 numbers, 2 and 3 strings")
        names = [name for of, name in self._caller.shared.signals if of is kinds[kind]]
        return names[index] if 0 <= index < len(names) else None

    def setStringProperty(self, target: Handle, name: str, value: TextOrBytes) -> None:
        """Set the text 'signal.NAME' of the scene (newer name of setStringSignal), or 'customData.NAME' of it or an
        object."""
        self._set_property(str, target, name, value)

    def getStringProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> str | bytes | None:
        """Return the text 'signal.NAME' of the scene, or 'customData.NAME' of it or an object."""
        if target in (self.handle_scene, self.handle_app) and name.startswith(_PREFIX):
            return self._get_text(self._signal(target, name))
        value: str | bytes | None = self._get_property(str, target, name)
        return value

    def setFloatProperty(self, target: Handle, name: str, value: float) -> None:
        """Set the number 'signal.NAME' of the scene (newer name of setFloatSignal), or 'customData.NAME' of it or an
        object."""
        self._set_property(float, target, name, value)

    def getFloatProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> float | None:
        """Return the number 'signal.NAME' of the scene, or 'customData.NAME' of it or an object."""
        value: float | None = self._get_property(float, target, name)
        return value

    def setIntProperty(self, target: Handle, name: str, value: int) -> None:
        """Set the integer 'signal.NAME' of the scene (newer name of setInt32Signal), or 'customData.NAME' of it or an
        object."""
        self._set_property(int, target, name, value)

    def getIntProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> int | None:
        """Return the integer 'signal.NAME' of the scene, or 'customData.NAME' of it or an object."""
        value: int | None = self._get_property(int, target, name)
        return value

    def _signal(self, target: int, name: str) -> str:
        if target not in (self.handle_scene, self.handle_app) or not name.startswith(_PREFIX):
            raise ValueError(
                f"object {target} has no property '{name}'; expected 'customData.NAME', or sim.handle_scene and "
                "'signal.NAME'"
            )
        return name.removeprefix(_PREFIX)

    def _data_key(self, target: int, name: str) -> tuple[int, str] | None:
        """Return the key of 'customData.NAME'; None for other properties."""
        if not name.startswith(_DATA_PREFIX):
            return None
        if target not in (self.handle_scene, self.handle_app):
            target = self._resolve(target)
            self._tree.kind(target)  # raises
        return target, name.removeprefix(_DATA_PREFIX)

    def _set_property(self, kind: type, target: int, name: str, value: object) -> None:
        key = self._data_key(target, name)
        if key is None:
            self._set(kind, self._signal(target, name), value)
        else:
            self._caller.shared.custom_data[key] = value

    def _get_property(self, kind: type, target: int, name: str) -> Any:
        key = self._data_key(target, name)
        if key is None:
            return self._get(kind, self._signal(target, name))
        value = self._caller.shared.custom_data.get(key)
        wanted = {float: (int, float), str: (str, bytes), dict: (dict, list, tuple)}.get(kind, kind)
        if value is not None:
            require_type(name, value, wanted)
        return value

    def _get_text(self, name: str) -> str | bytes | None:
        value: str | bytes | None = self._get(str, name)
        return self._scan(name) if value is None and name else value

    def _scan(self, name: str) -> bytes | None:
        """Return the points of the lidar that has this signal; computed here because most scans are not read."""
        lidar = self._world.find_signal(name)
        if lidar < 0:
            return None
        scan = read_lidar(self._simulation, lidar)
        if self._caller.shared.cleared_scans.get(name) == reading_time(self._simulation, lidar):
            return None
        points: bytes = scan.points.tobytes()
        return points

    def _set(self, kind: type, name: str, value: object) -> None:
        self._caller.shared.signals[kind, name] = value

    def _get(self, kind: type, name: str) -> Any:
        return self._caller.shared.signals.get((kind, name))

    def _clear(self, kind: type, name: str) -> None:
        self._caller.shared.signals.pop((kind, name), None)
