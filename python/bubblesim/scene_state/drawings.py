# SPDX-License-Identifier: BSD-3-Clause
"""Drawing objects: points, lines, triangles and simple shapes that scripts draw into the scene.

They have no effect on the simulation. Positions are metres, in the frame of the object that a drawing is attached to,
else in the world; quaternions x, y, z, w; colours red, green, blue from 0 to 1.
"""

from __future__ import annotations

import itertools
import math
from array import array
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

KINDS = ("points", "lines", "linestrip", "triangles", "triangle", "quad", "disc", "cube", "sphere")
"""Of the items. The size of points and lines is in pixels, that of others in metres."""

_COORDINATES = {"points": 3, "lines": 6, "linestrip": 3, "triangles": 9, "sphere": 3}  # 7 of all others: a pose
_MOST = 10_000  # drawings of a scene
_MOST_VALUES = 10_000_000  # of all items of a scene
_AROUND = tuple(itertools.product((-1.0, 0.0, 1.0), repeat=3))

_Cell = tuple[float, float, float]


@dataclass(frozen=True)
class Style:
    """What all items of a drawing have in common."""

    kind: str
    """One of KINDS."""
    size: float = 1.0
    colour: tuple[float, float, float] = (1.0, 1.0, 0.0)
    emission: tuple[float, float, float] = (0.0, 0.0, 0.0)
    opacity: float = 1.0
    """From 0 to 1."""
    colours: int = 0
    """Number of colour values of an item: 0, 3, or 3 for each of its vertices."""
    has_sizes: bool = False
    has_transparencies: bool = False
    cyclic: bool = False
    """A new item replaces the oldest one when the drawing is full."""
    overlay: bool = False
    """Shown in front of everything."""
    wireframe: bool = False

    @property
    def coordinates(self) -> int:
        """Return the number of values for the place of an item: its vertices, or a pose."""
        return _COORDINATES.get(self.kind, 7)

    @property
    def values(self) -> int:
        """Return the number of values of an item: coordinates, colours, size, transparency."""
        return self.coordinates + self.colours + self.has_sizes + self.has_transparencies


@dataclass
class Drawing:
    """Items of one style. Each item has a number, counted from the first one that was added."""

    handle: int
    type: int
    """As the script gave it: sim.drawing_points and so on, with flags."""
    style: Style
    capacity: int
    tolerance: float
    """m; an item that is closer than this to another one is not added."""
    parent: int
    """Handle of the object that it is attached to; -1 for the world."""
    temporary: bool
    """It ends with the run in which it was created."""
    changed: int
    """Revision of its last change."""
    first: int = 0
    """Number of the oldest item that is kept."""
    _rows: array[float] = field(default_factory=lambda: array("f"))
    _revisions: array[int] = field(default_factory=lambda: array("q"))  # of the additions, rising
    _dropped: int = 0  # number of the first item in _rows
    _cells: dict[_Cell, list[int]] = field(default_factory=dict)
    """Numbers of items by the cell of a grid, as wide as the tolerance, that they are in; without a tolerance none."""

    @property
    def stored_values(self) -> int:
        """Return the number of values in memory."""
        return len(self._rows)

    @property
    def end(self) -> int:
        """Return the number of items added so far."""
        return self._dropped + len(self._revisions)

    def items(self, start: int = 0) -> npt.NDArray[np.float32]:
        """Return the kept items from number ``start`` on, one in a row."""
        begin = max(start, self.first) - self._dropped
        rows = np.array(self._rows, dtype=np.float32).reshape(-1, self.style.values)
        return rows[begin:]

    def add(self, values: Sequence[float], revision: int) -> bool:
        """Add an item and return True, or False if the drawing is full or has one at this place."""
        full = self.end - self.first >= self.capacity
        if (full and not self.style.cyclic) or self._has_item_at(values[:3]):
            return False
        if self.tolerance > 0.0:
            self._cells.setdefault(self._cell(values), []).append(self.end)
        self._rows.extend(values)
        self._revisions.append(revision)
        if full:
            self.first += 1
            if self.first - self._dropped >= self.capacity:
                self._drop()
        return True

    def clear(self) -> None:
        """Remove all items."""
        self.first = self.end
        self._drop()

    def added_after(self, revision: int) -> int:
        """Return the number of the first item that was added after a revision."""
        return max(self.first, self._dropped + bisect_right(self._revisions, revision))

    def _drop(self) -> None:
        count = self.first - self._dropped
        del self._rows[: count * self.style.values]
        del self._revisions[:count]
        self._dropped = self.first
        kept = {cell: [each for each in numbers if each >= self.first] for cell, numbers in self._cells.items()}
        self._cells = {cell: numbers for cell, numbers in kept.items() if numbers}

    def _has_item_at(self, place: Sequence[float]) -> bool:
        if self.tolerance <= 0.0:
            return False
        x, y, z = self._cell(place)
        near = (self._cells.get((x + dx, y + dy, z + dz), ()) for dx, dy, dz in _AROUND)
        return any(
            number >= self.first and math.dist(self._place(number), place) < self.tolerance
            for number in itertools.chain.from_iterable(near)
        )

    def _cell(self, place: Sequence[float]) -> _Cell:
        return place[0] // self.tolerance, place[1] // self.tolerance, place[2] // self.tolerance

    def _place(self, number: int) -> array[float]:
        begin = (number - self._dropped) * self.style.values
        return self._rows[begin : begin + 3]


class Drawings:
    """The drawings of a simulation by handle."""

    def __init__(self) -> None:
        """Create it without drawings."""
        self.by_handle: dict[int, Drawing] = {}
        self.revision = 0
        """Rises with each change."""
        self._created = 0
        self._values = 0  # of all items

    def create(
        self,
        object_type: int,
        style: Style,
        *,
        capacity: int,
        tolerance: float = 0.0,
        parent: int = -1,
        temporary: bool = True,
    ) -> Drawing:
        """Add a drawing without items."""
        if len(self.by_handle) >= _MOST:
            raise ValueError(f"a scene has at most {_MOST} drawing objects: remove some")
        self.revision += 1
        self._created += 1
        drawing = Drawing(self._created, object_type, style, capacity, tolerance, parent, temporary, self.revision)
        self.by_handle[drawing.handle] = drawing
        return drawing

    def add_item(self, handle: int, values: Sequence[float]) -> bool:
        """Add an item to a drawing; see Drawing.add."""
        drawing = self.by_handle[handle]
        if self._values >= _MOST_VALUES:
            raise ValueError(f"the drawing objects of a scene have at most {_MOST_VALUES} numbers: remove some items")
        before = drawing.stored_values
        if not drawing.add(values, self.revision + 1):
            return False
        self._values += drawing.stored_values - before
        self.revision += 1
        drawing.changed = self.revision
        return True

    def clear_items(self, handle: int) -> None:
        """Remove all items of a drawing."""
        self.revision += 1
        drawing = self.by_handle[handle]
        self._values -= drawing.stored_values
        drawing.clear()
        drawing.changed = self.revision

    def remove(self, handle: int) -> None:
        """Remove a drawing if it is there."""
        drawing = self.by_handle.pop(handle, None)
        if drawing is not None:
            self._values -= drawing.stored_values
            self.revision += 1

    def remove_below(self, parents: set[int]) -> None:
        """Remove the drawings that are attached to objects that are about to be removed."""
        for drawing in [drawing for drawing in self.by_handle.values() if drawing.parent in parents]:
            self.remove(drawing.handle)

    def end_run(self) -> None:
        """Remove the drawings that were created during the run that has ended."""
        for drawing in [drawing for drawing in self.by_handle.values() if drawing.temporary]:
            self.remove(drawing.handle)
