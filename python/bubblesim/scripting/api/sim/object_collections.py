# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for collections of objects."""

from __future__ import annotations

from bubblesim._core import RunState
from bubblesim.scene_state.object_collections import Collection, Item
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Handle
from bubblesim.scripting.api.sim.context import ApiContext

_REMOVE, _WITHOUT_BASE = 1, 2


class CollectionFunctions(ApiContext):
    """Sets of objects, for sensors that detect these alone. A collection that is created while the simulation runs ends
    with the run."""

    @differs("options make copies that stay; here a collection always follows the tree")
    def createCollection(self, options: int = 0) -> int:
        """Create an empty collection and return its handle; the options have no effect."""
        return self._caller.shared.collections.create(temporary=self._runner.state != RunState.STOPPED)

    def addItemToCollection(self, collection: Handle, what: int, handle: int, options: int = 0) -> None:
        """Add objects: ``what`` is sim.handle_all, or an object alone (handle_single), with all below (handle_tree) or
        all above it (handle_chain). Options: 1 removes them instead, 2 leaves the object itself out.
        """
        known = (self.handle_all, self.handle_single, self.handle_tree, self.handle_chain)
        if what not in known:
            raise ValueError(
                f"{what} is not a set of objects: use sim.handle_all, handle_single, handle_tree or handle_chain"
            )
        base = -1
        if what != self.handle_all:
            base = self._resolve(handle)
            self._tree.kind(base)  # raises
        item = Item(what, base, removes=bool(options & _REMOVE), without_base=bool(options & _WITHOUT_BASE))
        self._collection(collection).items.append(item)

    def getCollectionObjects(self, collection: Handle) -> list[int]:
        """Return the handles of the objects in a collection."""
        items = self._collection(collection)
        roots = self._tree.children(self.handle_world)
        everything = [handle for root in roots for handle in self._tree.with_all_below(root)]
        return [handle for handle in everything if self._contains(items, handle)]

    def destroyCollection(self, collection: Handle) -> None:
        """Remove a collection; sensors that were limited to it detect all objects."""
        self._collection(collection)
        self._caller.shared.collections.remove(collection)

    def addObjectToCollection(self, collection: Handle, handle: int, what: int, options: int = 0) -> int:
        """Add objects (old name of addItemToCollection, with other arguments); return 1."""
        self.addItemToCollection(collection, what, handle, options)
        return 1

    def emptyCollection(self, collection: Handle) -> int:
        """Remove a collection, as in the original (old name of destroyCollection); return 1."""
        self.destroyCollection(collection)
        return 1

    def removeCollection(self, collection: Handle) -> int:
        """Remove a collection (old name of destroyCollection); return 1."""
        self.destroyCollection(collection)
        return 1

    def getCollectionName(self, collection: Handle) -> str:
        """Return the name of a collection that scripts have named, else an empty string (old name)."""
        self._collection(collection)
        names = self._caller.shared.collections.by_name
        return next((name for name, handle in names.items() if handle == collection), "")

    def setCollectionName(self, collection: Handle, name: str) -> int:
        """Name a collection, for getCollectionHandle (old name); return 1."""
        self._collection(collection)
        names = self._caller.shared.collections.by_name
        for known in [known for known, handle in names.items() if handle == collection]:
            del names[known]
        names[name] = collection
        return 1

    def _saved_collection(self, name: str) -> int:
        """Create a collection as the scene's file has it; an empty one if it has none of that name."""
        handle = self.createCollection(0)
        kinds = {"object": self.handle_single, "tree": self.handle_tree, "chain": self.handle_chain}
        for saved, items in self._simulation.file_collections():
            if saved == name:
                self._collection(handle).items += [
                    Item(kinds.get(what, self.handle_all), base, removes=removes, without_base=False)
                    for what, base, removes in items
                ]
        return handle

    def _collection(self, handle: int) -> Collection:
        try:
            return self._caller.shared.collections.by_handle[handle]
        except KeyError:
            raise LookupError(f"no collection has the handle {handle}") from None

    def _is_entity(self, entity: int) -> bool:
        """Return whether a number stands for all objects, a collection or an object."""
        known = self._caller.shared.collections.by_handle
        return entity == self.handle_all or entity in known or self._tree.contains(entity)

    def _belongs(self, handle: int, entity: int) -> bool:
        """Return whether an object is, or is below, ``entity``, an object, a collection or sim.handle_all."""
        if entity == self.handle_all:
            return True
        collection = self._caller.shared.collections.by_handle.get(entity)
        return self._is_below(handle, entity) if collection is None else self._contains(collection, handle)

    def _contains(self, collection: Collection, handle: int) -> bool:
        contained = False
        for item in collection.items:
            if self._matches(item, handle):
                contained = not item.removes
        return contained

    def _matches(self, item: Item, handle: int) -> bool:
        if item.what == self.handle_all:
            return True
        if item.without_base and handle == item.handle:
            return False
        if item.what == self.handle_chain:
            return self._is_below(item.handle, handle)
        if item.what == self.handle_tree or self._tree.kind(item.handle) == "model":  # a model alone is all its links
            return self._is_below(handle, item.handle)
        return handle == item.handle

    def _is_below(self, handle: int, above: int) -> bool:
        """Return whether an object is another one or its descendant."""
        while handle >= 0 and handle != above:
            handle = self._tree.parent(handle)
        return handle >= 0
