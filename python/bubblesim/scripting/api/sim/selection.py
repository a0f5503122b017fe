# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for the objects that are selected."""

from __future__ import annotations

from typing import Any

from bubblesim.scripting.api.kinds import Handle, Integers
from bubblesim.scripting.api.sim.context import ApiContext


class SelectionFunctions(ApiContext):
    """Scripts and programs share a selection of objects. It is not that of the window, where each page has its own."""

    def getObjectSel(self) -> list[int]:
        """Return the handles of the selected objects, the last one selected last."""
        selected = self._caller.shared.selected
        selected[:] = [handle for handle in selected if self._tree.contains(handle)]
        return [self._shown(handle) for handle in selected]

    def setObjectSel(self, handles: Integers) -> None:
        """Select these objects and no others."""
        resolved = [self._resolve(handle) for handle in handles]
        for handle in resolved:
            self._tree.kind(handle)  # raises
        self._caller.shared.selected[:] = dict.fromkeys(resolved)

    def getObjectSelection(self) -> list[int] | None:
        """Return the handles of the selected objects; None (nil) if there are none (old name)."""
        return self.getObjectSel() or None

    def setObjectSelection(self, handles: Integers) -> int:
        """Select these objects and no others (old name); return 1."""
        self.setObjectSel(handles)
        return 1

    def isObjectInSelection(self, handle: Handle) -> int:
        """Return 1 if an object is selected, else 0 (old name)."""
        return int(self._resolve(handle) in self._caller.shared.selected)

    def getObjectSelectionSize(self) -> int:
        """Return the number of selected objects (old name)."""
        return len(self.getObjectSel())

    def getObjectLastSelection(self) -> int:
        """Return the object that was selected last, -1 if none is (old name)."""
        return (self.getObjectSel() or [-1])[-1]

    def addObjectToSelection(self, what: Any, handle: int = -1) -> int:
        """Select objects in addition (old name): sim.handle_single and a handle, sim.handle_tree, handle_chain,
        handle_all, or a list of handles."""
        selected = self._caller.shared.selected
        selected += [each for each in self._meant(what, handle) if each not in selected]
        return 1

    def removeObjectFromSelection(self, what: Any, handle: int = -1) -> int:
        """Select objects no longer (old name): the arguments are those of addObjectToSelection."""
        removed = set(self._meant(what, handle))
        selected = self._caller.shared.selected
        selected[:] = [each for each in selected if each not in removed]
        return 1

    def _meant(self, what: Any, handle: int) -> list[int]:
        if isinstance(what, list | tuple):
            return [self._resolve(int(each)) for each in what]
        if isinstance(what, dict):  # an empty table of Lua
            return []
        if what == self.handle_all:
            return [each for root in self._tree.children(self.handle_world) for each in self._tree.with_all_below(root)]
        handle = self._resolve(handle if what in (self.handle_single, self.handle_tree, self.handle_chain) else what)
        self._tree.kind(handle)  # raises
        if what == self.handle_tree:
            return self._tree.with_all_below(handle)
        chain = [handle]
        while what == self.handle_chain and (above := self._tree.parent(chain[-1])) >= 0:
            chain.append(above)
        return chain
