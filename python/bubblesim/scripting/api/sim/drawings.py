# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that draw points, lines and simple shapes into the scene."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from bubblesim._core import RunState
from bubblesim.geometry import poses
from bubblesim.scene_state.drawings import Drawing, Style
from bubblesim.scripting.api.kinds import NumbersOrNothing
from bubblesim.scripting.api.sim.context import ApiContext

_MOST_ITEMS = 1_000_000
_TYPE = 0x1F
_KINDS = {
    0: "points",
    1: "lines",
    2: "triangles",
    3: "triangle",
    4: "quad",
    5: "disc",
    6: "cube",
    7: "sphere",
    8: "linestrip",
    9: "triangle",
    10: "quad",
    11: "disc",
    12: "cube",
}
_WITH_NORMALS = range(3, 7)  # types of older scripts: position and normal in place of a pose
_VERTICES = {"lines": 2, "triangles": 3, "linestrip": 1}


class DrawingFunctions(ApiContext):
    """Drawing objects show points, lines and simple shapes in viewers, and have no effect on the simulation. With ROS,
    they are published as markers on /bubblesim/drawings. They are removed with the script that created them, at the
    end of a run, or with the object that they are attached to."""

    def addDrawingObject(
        self,
        object_type: int,
        size: float,
        duplicate_tolerance: float = 0.0,
        parent: int = -1,
        max_items: int = 0,
        colour: NumbersOrNothing = None,
        reserved: Any = None,
        specular: NumbersOrNothing = None,
        emission: NumbersOrNothing = None,
    ) -> int:
        """Create a drawing object without items and return its handle.

        ``object_type``: sim.drawing_points or drawing_lines (``size`` in pixels), drawing_linestrip, drawing_triangles,
        drawing_trianglepts, drawing_quadpts, drawing_discpts, drawing_cubepts or drawing_spherepts (``size`` in
        metres), plus sim.drawing_itemcolors, drawing_vertexcolors, drawing_itemsizes, drawing_itemtransparency,
        drawing_cyclic, drawing_local, drawing_overlay, drawing_wireframe, drawing_50percenttransparency and others.
        ``parent``: the items move with this object; -1 for the world. ``max_items``: 0 is 1000000.
        """
        kind = _KINDS.get(object_type & _TYPE)
        if kind is None:
            raise ValueError(f"{object_type & _TYPE} is not a type of drawing; valid ones: sim.drawing_points, ...")
        if not (math.isfinite(size) and math.isfinite(duplicate_tolerance)):
            raise ValueError("size and duplicate_tolerance must be finite")
        if parent != self.handle_world:
            parent = self._resolve(parent)
            self._tree.kind(parent)  # raises
        drawing = self._caller.shared.drawings.create(
            object_type,
            self._style(object_type, kind, size, colour, emission),
            capacity=min(max_items, _MOST_ITEMS) if max_items > 0 else _MOST_ITEMS,
            tolerance=duplicate_tolerance,
            parent=parent,
            temporary=self._runner.state != RunState.STOPPED,
        )
        if not self._caller.is_remote:
            handle = drawing.handle
            self._caller.at_end["drawing", handle] = lambda: self._caller.shared.drawings.remove(handle)
        return drawing.handle

    def addDrawingObjectItem(self, drawing: int, item: NumbersOrNothing = None) -> int:
        """Add an item and return 1, or 0 if the drawing is full or has one at this place; without an item, remove all.

        An item is a list of numbers in the world, with sim.drawing_local in the parent: x, y, z of a point, of the next
        point of a strip or of a sphere; two or three points of a line or triangle; x, y, z and a quaternion for
        drawing_trianglepts, quadpts, discpts and cubepts, whose z axis is the normal (drawing_trianglepoints and so on:
        the normal instead). Then red, green, blue, size and transparency as far as the type has them. With
        sim.handleflag_addmultiple added to the handle, the list holds several items.
        """
        several = bool(drawing & self.handleflag_addmultiple)
        handle = drawing & ~self.handleflag_addmultiple
        found = self._drawing(handle)
        drawings = self._caller.shared.drawings
        if item is None:
            drawings.clear_items(handle)
            return 1
        flags = found.type
        old = (flags & _TYPE) in _WITH_NORMALS
        count = found.style.values - old
        if not several:
            item = item[:count]  # scripts use one list for drawings of several types
        if not item or len(item) % count:
            needed = f"a multiple of {count}" if several else str(count)
            raise ValueError(
                f"sim.addDrawingObjectItem: an item of this drawing has {needed} numbers, found {len(item)}"
            )
        if not all(map(math.isfinite, item)):
            raise ValueError("sim.addDrawingObjectItem: all numbers of an item must be finite")
        local = found.parent < 0 or bool(flags & self.drawing_local)
        inverse = None if local else poses.inverse(self._tree.pose(found.parent))
        added = True
        for begin in range(0, len(item), count):
            values = item[begin : begin + count]
            if old:
                values = [*values[:3], *_turned_to(values[3:6]), *values[6:]]
            if inverse is not None:
                values = [*_in_frame(inverse, values, found.style), *values[found.style.coordinates :]]
            added = drawings.add_item(handle, values) and added
        return int(added)

    def removeDrawingObject(self, drawing: int) -> None:
        """Remove a drawing object, or all with sim.handle_all."""
        drawings = self._caller.shared.drawings
        handles = list(drawings.by_handle) if drawing == self.handle_all else [self._drawing(drawing).handle]
        for handle in handles:
            drawings.remove(handle)
            self._caller.at_end.pop(("drawing", handle), None)

    def getDrawings(self, since: int = 0) -> dict[str, Any]:
        """Return what has changed after a revision, for viewers; 0 returns everything.

        The result has ``revision`` to pass next time, ``handles`` of all drawings, ``poses`` in the world of the
        objects that they are attached to (x, y, z and quaternion, by handle) and ``changed`` drawings: their style,
        ``parent``, ``first`` (the number of the oldest item that is kept), ``start`` (the number of the first item in
        ``items``), and ``items``: 32 bit floats as bytes, ``values`` for each item.
        """
        drawings = self._caller.shared.drawings
        since = since if 0 <= since <= drawings.revision else 0
        every = drawings.by_handle.values()
        return {
            "revision": drawings.revision,
            "handles": list(drawings.by_handle),
            "poses": {
                str(parent): self._tree.pose(parent) for parent in {each.parent for each in every} if parent >= 0
            },
            "changed": [_shown(each, since) for each in every if each.changed > since],
        }

    def _drawing(self, handle: int) -> Drawing:
        found = self._caller.shared.drawings.by_handle.get(handle)
        if found is None:
            raise ValueError(f"{handle} is not the handle of a drawing object")
        return found

    def _style(
        self, flags: int, kind: str, size: float, colour: Sequence[float] | None, emission: Sequence[float] | None
    ) -> Style:
        vertices = _VERTICES.get(kind, 0)
        coloured_vertices = bool(flags & self.drawing_vertexcolors and vertices and not flags & self.drawing_itemcolors)
        transparency = (
            0.5 * bool(flags & self.drawing_50percenttransparency)
            + 0.25 * bool(flags & self.drawing_25percenttransparency)
            + 0.125 * bool(flags & self.drawing_12percenttransparency)
        )
        return Style(
            kind=kind,
            size=min(max(size, 0.0001), 100.0),
            colour=_colour(colour, (1.0, 1.0, 0.0)),
            emission=_colour(emission, (0.0, 0.0, 0.0)),
            opacity=1.0 - transparency,
            colours=3 * vertices if coloured_vertices else 3 if flags & self.drawing_itemcolors else 0,
            has_sizes=bool(flags & self.drawing_itemsizes) and kind != "triangles",
            has_transparencies=bool(flags & self.drawing_itemtransparency) and not coloured_vertices,
            cyclic=bool(flags & self.drawing_cyclic),
            overlay=bool(flags & self.drawing_overlay),
            wireframe=bool(flags & self.drawing_wireframe),
        )


def _colour(given: Sequence[float] | None, default: tuple[float, float, float]) -> tuple[float, float, float]:
    """Return the first three of the given numbers; older scripts give twelve."""
    if given is None:
        return default
    if len(given) < 3:
        raise ValueError(f"a colour has three numbers (red, green, blue from 0 to 1), found {len(given)}")
    red, green, blue = (min(max(float(value), 0.0), 1.0) for value in given[:3])
    return red, green, blue


def _turned_to(normal: Sequence[float]) -> list[float]:
    """Return the shortest rotation, x, y, z, w, of the z axis to a direction."""
    length = math.hypot(*normal)
    x, y, z = (value / length for value in normal) if length > 0.0 else (0.0, 0.0, 1.0)
    if z < -0.999999:
        return [1.0, 0.0, 0.0, 0.0]
    w = math.sqrt(0.5 * (1.0 + z))
    return [-0.5 * y / w, 0.5 * x / w, 0.0, w]


def _in_frame(inverse: Sequence[float], values: Sequence[float], style: Style) -> list[float]:
    """Return the coordinates of an item in a frame, given the inverse of the frame's pose."""
    if style.coordinates == 7:
        return list(poses.multiply(inverse, values[:7]))
    moved: list[float] = []
    for begin in range(0, style.coordinates, 3):
        moved += poses.transform(inverse, values[begin : begin + 3])
    return moved


def _shown(drawing: Drawing, since: int) -> dict[str, Any]:
    start = drawing.added_after(since)
    style = drawing.style
    return {
        "handle": drawing.handle,
        "parent": drawing.parent,
        "kind": style.kind,
        "size": style.size,
        "colour": list(style.colour),
        "emission": list(style.emission),
        "opacity": style.opacity,
        "overlay": style.overlay,
        "wireframe": style.wireframe,
        "values": style.values,
        "coordinates": style.coordinates,
        "colours": style.colours,
        "sizes": style.has_sizes,
        "transparencies": style.has_transparencies,
        "first": drawing.first,
        "start": start,
        "items": drawing.items(start).tobytes(),
    }
