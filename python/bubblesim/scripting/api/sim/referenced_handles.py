# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that keep handles with objects, and data beside the scene."""

from __future__ import annotations

from typing import Any

from bubblesim.scripting.api.kinds import DataOrNothing, Handle, Integers
from bubblesim.scripting.api.sim.context import ApiContext

_NONE: list[int] = []


class ReferencedHandleFunctions(ApiContext):
    """An object keeps lists of handles by a tag. Persistent data stay when the simulation stops, until the node
    ends."""

    def setReferencedHandles(self, handle: Handle, handles: Integers = _NONE, tag: str = "") -> int:
        """Keep handles with an object; return 1. Handles below 0 are kept as they are."""
        resolved = [each if each < 0 else self._resolve(each) for each in handles]
        self._caller.shared.settings[list, self._key_of(handle, tag)] = resolved
        return 1

    def getReferencedHandles(self, handle: Handle, tag: str = "") -> list[int]:
        """Return the handles that an object keeps; -1 for objects that were removed."""
        kept = self._caller.shared.settings.get((list, self._key_of(handle, tag)), _NONE)
        return [self._shown(each) if each < 0 or self._tree.contains(each) else -1 for each in kept]

    def getReferencedHandlesTags(self, handle: Handle) -> list[str]:
        """Return the tags under which an object keeps handles."""
        begin = self._key_of(handle, "")
        keys = [str(key) for kind, key in self._caller.shared.settings if kind is list]
        return [key.removeprefix(begin) for key in keys if key.startswith(begin)]

    def getObjectFromUid(self, uid: int, options: Any = None) -> int:
        """Return the object with a number of getObjectUid; -1 if there is none."""
        return self._shown(uid) if uid >= 0 and self._tree.contains(self._resolve(uid)) else -1

    def persistentDataWrite(self, tag: str, data: DataOrNothing = None, options: int = 0) -> None:
        """Keep bytes or a string under a tag; none remove it. No ``options`` write files."""
        settings = self._caller.shared.settings
        if data:
            settings[bytes, f"persistent {tag}"] = data
        else:
            settings.pop((bytes, f"persistent {tag}"), None)

    def persistentDataRead(self, tag: str) -> str | bytes | None:
        """Return what was kept under a tag; None (nil) if there is nothing."""
        data: str | bytes | None = self._caller.shared.settings.get((bytes, f"persistent {tag}"))
        return data

    def getPersistentDataTags(self) -> list[str]:
        """Return the tags of all persistent data."""
        keys = [str(key) for kind, key in self._caller.shared.settings if kind is bytes]
        return [key.removeprefix("persistent ") for key in keys]

    def copyTable(self, table: Any) -> Any:
        """Return a copy of a table with all in it."""
        if isinstance(table, dict):
            return {key: self.copyTable(value) for key, value in table.items()}
        return [self.copyTable(value) for value in table] if isinstance(table, list | tuple) else table

    def _key_of(self, handle: int, tag: str) -> str:
        owner = handle
        if handle != self.handle_scene:
            owner = self._resolve(handle)
            self._tree.kind(owner)  # raises
        return f"references of {owner} {tag}"
