# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for data that is attached to objects or the scene."""

from __future__ import annotations

from typing import Any

from bubblesim.scripting.api.kinds import NO_OPTIONS, Bytes, DataOrNothing, Handle, Options
from bubblesim.scripting.api.sim.signals import SignalFunctions


class CustomDataFunctions(SignalFunctions):
    """Data by object, or sim.handle_scene, and name. It stays when the simulation stops, until the node ends."""

    def writeCustomDataBlock(self, handle: Handle, tag: str, data: DataOrNothing = None) -> None:
        """Attach bytes or a string to an object; nothing (nil) or empty data removes it (old name)."""
        self._write(handle, tag, data)

    def readCustomDataBlock(self, handle: Handle, tag: str) -> str | bytes | None:
        """Return what was attached; None (nil) if there is nothing (old name)."""
        data: str | bytes | None = self._read(handle, tag)
        return data

    def readCustomDataBlockTags(self, handle: Handle) -> list[str]:
        """Return the names of the data of an object (old name)."""
        return self._tags(handle)

    def writeCustomStringData(self, handle: Handle, tag: str, data: DataOrNothing = None) -> None:
        """Attach a string to an object; an empty one removes it."""
        self._write(handle, tag, data)

    def readCustomStringData(self, handle: Handle, tag: str) -> str | bytes | None:
        """Return a string that was attached; None (nil) if there is none."""
        return self.readCustomDataBlock(handle, tag)

    def readCustomStringDataTags(self, handle: Handle) -> list[str]:
        """Return the names of the data of an object."""
        return self._tags(handle)

    def writeCustomBufferData(self, handle: Handle, tag: str, data: DataOrNothing = None) -> None:
        """Attach bytes to an object; none remove them."""
        self._write(handle, tag, data)

    def readCustomBufferData(self, handle: Handle, tag: str) -> str | bytes | None:
        """Return bytes that were attached; None (nil) if there are none."""
        return self.readCustomDataBlock(handle, tag)

    def writeCustomTableData(self, handle: Handle, tag: str, table: Any = None) -> None:
        """Attach a table to an object; an empty one removes it."""
        self._write(handle, tag, table)

    def readCustomTableData(self, handle: Handle, tag: str) -> Any:
        """Return a table that was attached; an empty one if there is none."""
        return self._read(handle, tag) or {}

    def setBoolProperty(self, target: Handle, name: str, value: bool) -> None:
        """Set the flag 'signal.NAME' of the scene, or 'customData.NAME' of the scene or an object."""
        self._set_property(bool, target, name, value)

    def getBoolProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> bool | None:
        """Return the flag 'signal.NAME' of the scene, or 'customData.NAME' of the scene or an object."""
        value: bool | None = self._get_property(bool, target, name)
        return value

    def setBufferProperty(self, target: Handle, name: str, value: Bytes) -> None:
        """Set the bytes 'signal.NAME' of the scene, or 'customData.NAME' of the scene or an object."""
        self._set_property(bytes, target, name, value)

    def getBufferProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> bytes | None:
        """Return the bytes 'signal.NAME' of the scene, or 'customData.NAME' of the scene or an object."""
        value: bytes | None = self._get_property(bytes, target, name)
        return value

    def setTableProperty(self, target: Handle, name: str, value: Any) -> None:
        """Set the table 'signal.NAME' of the scene, or 'customData.NAME' of the scene or an object."""
        self._set_property(dict, target, name, value)

    def getTableProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return the table 'signal.NAME' of the scene, or 'customData.NAME' of the scene or an object."""
        return self._get_property(dict, target, name)

    def removeProperty(self, target: Handle, name: str) -> None:
        """Remove what was set as 'signal.NAME' or 'customData.NAME', of any kind."""
        key = self._data_key(target, name)
        if key is not None:
            self._caller.shared.custom_data.pop(key, None)
            return
        for kind in (str, float, int, bool, bytes, dict):
            self._clear(kind, self._signal(target, name))

    def _key(self, handle: int, tag: str) -> tuple[int, str]:
        if handle not in (self.handle_scene, self.handle_app):
            handle = self._resolve(handle)
            self._tree.kind(handle)  # raises
        return handle, tag

    def _write(self, handle: int, tag: str, data: Any) -> None:
        key = self._key(handle, tag)
        if data or tag in self._of_file(key[0]):
            self._caller.shared.custom_data[key] = data or b""
        else:
            self._caller.shared.custom_data.pop(key, None)

    def _read(self, handle: int, tag: str) -> Any:
        key = self._key(handle, tag)
        data = self._caller.shared.custom_data.get(key)
        return (self._of_file(key[0]).get(tag) if data is None else data) or None

    def _tags(self, handle: int) -> list[str]:
        owner, _ = self._key(handle, "")
        tags = [*self._of_file(owner), *(tag for of, tag in self._caller.shared.custom_data if of == owner)]
        return [tag for tag in dict.fromkeys(tags) if self._read(handle, tag) is not None]

    def _of_file(self, owner: int) -> dict[str, bytes]:
        """Return the data that the scene's file attaches to an object."""
        return {} if owner < 0 else self._world.file_data(owner)
