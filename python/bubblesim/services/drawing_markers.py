# SPDX-License-Identifier: BSD-3-Clause
"""The topic /bubblesim/drawings: the drawing objects of scripts as visualization_msgs/MarkerArray.

The markers are in the frame that the parameter ~drawings_frame of the node names, "world" by default: the world
frame of the scene. The namespace of the markers of a drawing is its handle.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from bubblesim._core import NoParameterServer
from bubblesim.geometry.poses import IDENTITY
from bubblesim.ros_messages import pose_message
from bubblesim.scene_state.drawings import Drawing
from bubblesim.scene_state.object_tree import ObjectTree
from bubblesim.scene_state.shared_data import SharedData

TOPIC = "/bubblesim/drawings"
_PERIOD = 0.05  # s of wall time between two messages
_REFRESH = 1.0  # s after which everything is sent again, for nodes that subscribe later
_PIXEL = 0.004  # m; markers have no sizes in pixels
_SPHERE, _LINE_STRIP, _LINE_LIST, _SPHERE_LIST, _POINTS, _TRIANGLE_LIST = 2, 4, 5, 7, 8, 11
_ADD, _DELETE = 0, 2
_DISC_CORNERS = 16

Message = dict[str, Any]
Array = npt.NDArray[np.float64]


def _frame_of(bridge: Any) -> str:
    try:
        found, frame = bridge.get_parameter("~drawings_frame")
    except NoParameterServer:
        return "world"
    return frame if found and isinstance(frame, str) else "world"


class DrawingMarkers:
    """Advertised during the lifetime of the bridge."""

    def __init__(self, bridge: Any, simulation: Any, shared: SharedData) -> None:
        """Advertise the topic."""
        self._bridge = bridge
        self._simulation = simulation
        self._drawings = shared.drawings
        self._tree = ObjectTree(simulation.world, shared.dummies, shared.edits)
        self._frame = _frame_of(bridge)
        self._publisher = bridge.advertise(TOPIC, "visualization_msgs/MarkerArray", 10)
        self._sent: dict[int, tuple[int, list[float], int]] = {}  # by handle: change, parent's pose, number of markers
        self._next = self._next_refresh = 0.0

    def publish(self) -> None:
        """Publish what has changed, if there are subscribers."""
        now = time.monotonic()
        if now < self._next or not (self._drawings.by_handle or self._sent):
            return
        if not self._bridge.wants_messages(self._publisher):
            self._next_refresh = 0.0
            return
        self._next = now + _PERIOD
        everything = now >= self._next_refresh
        if everything:
            self._next_refresh = now + _REFRESH
        markers = self._changed_markers(everything=everything)
        if markers:
            self._bridge.publish(self._publisher, {"markers": markers})

    def _changed_markers(self, *, everything: bool) -> list[Message]:
        header = {"frame_id": self._frame, "stamp": self._simulation.state_time}
        markers: list[Message] = []
        for handle in [handle for handle in self._sent if handle not in self._drawings.by_handle]:
            markers += _deletions(header, handle, range(self._sent.pop(handle)[2]))
        for handle, drawing in self._drawings.by_handle.items():
            pose = list(IDENTITY) if drawing.parent < 0 else [float(v) for v in self._tree.pose(drawing.parent)]
            before = self._sent.get(handle)
            if not everything and before is not None and before[:2] == (drawing.changed, pose):
                continue
            shown = markers_of(drawing, pose, header)
            markers += shown
            if before is not None:
                markers += _deletions(header, handle, range(len(shown), before[2]))
            self._sent[handle] = drawing.changed, pose, len(shown)
        return markers


def markers_of(drawing: Drawing, pose: Sequence[float], header: Message) -> list[Message]:
    """Return the markers of a drawing; none if it is empty.

    :param pose: of the frame of its items, in the frame of the header.
    """
    rows: Array = drawing.items().astype(float)
    if not len(rows):
        return []
    style = drawing.style
    places = rows[:, : style.coordinates]
    colours = _colours(drawing, rows)
    of_vertices = style.colours > 3
    sizes = rows[:, style.coordinates + style.colours] if style.has_sizes else np.full(len(rows), style.size)
    if style.kind == "sphere":
        if style.has_sizes:
            return [
                _marker(header, drawing, n, _SPHERE, pose, size, [], colour[None], centre)
                for n, (centre, colour, size) in enumerate(zip(places, colours, sizes, strict=True))
            ]
        return [_marker(header, drawing, 0, _SPHERE_LIST, pose, style.size, places, colours)]
    if style.kind == "points":
        return [_marker(header, drawing, 0, _POINTS, pose, style.size * _PIXEL, places, colours)]
    if style.kind == "linestrip":
        if len(rows) < 2:
            return []
        return [_marker(header, drawing, 0, _LINE_STRIP, pose, style.size * _PIXEL, places, colours)]
    if style.kind == "lines":
        return [
            _marker(
                header,
                drawing,
                0,
                _LINE_LIST,
                pose,
                style.size * _PIXEL,
                _points(places),
                _repeated(colours, 1 if of_vertices else 2),
            )
        ]
    if style.kind == "triangles":
        return [
            _marker(
                header,
                drawing,
                0,
                _TRIANGLE_LIST,
                pose,
                1.0,
                _points(places),
                _repeated(colours, 1 if of_vertices else 3),
            )
        ]
    corners = _SHAPES[style.kind]
    vertices = np.concatenate([_placed(corners * size, place) for place, size in zip(places, sizes, strict=True)])
    return [_marker(header, drawing, 0, _TRIANGLE_LIST, pose, 1.0, vertices, _repeated(colours, len(corners)))]


def _deletions(header: Message, handle: int, numbers: range) -> list[Message]:
    return [{"header": header, "ns": str(handle), "id": number, "action": _DELETE} for number in numbers]


def _marker(
    header: Message,
    drawing: Drawing,
    number: int,
    marker_type: int,
    pose: Sequence[float],
    size: float,
    points: Any,
    colours: Array,
    centre: Any = None,
) -> Message:
    where = list(pose)
    if centre is not None:
        where[:3] = _placed(np.asarray(centre)[None], np.asarray(pose))[0].tolist()
    message = {
        "header": header,
        "ns": str(drawing.handle),
        "id": number,
        "type": marker_type,
        "action": _ADD,
        "pose": pose_message(where),
        "scale": {"x": float(size), "y": float(size), "z": float(size)},
        "color": _colour_message(colours[0]),
        "points": [{"x": x, "y": y, "z": z} for x, y, z in np.asarray(points, dtype=float).reshape(-1, 3).tolist()],
    }
    if len(colours) > 1 and (colours != colours[0]).any():
        message["colors"] = [_colour_message(colour) for colour in colours]
    return message


def _colour_message(colour: Array) -> Message:
    return dict(zip("rgba", map(float, colour), strict=True))


def _colours(drawing: Drawing, rows: Array) -> Array:
    """Return red, green, blue, opacity of each item, or of each vertex where these have colours."""
    style = drawing.style
    begin = style.coordinates
    if style.colours:
        plain = rows[:, begin : begin + style.colours].reshape(-1, 3)
    else:
        plain = np.tile(np.maximum(style.colour, style.emission), (len(rows), 1))
    opacity: Array = np.full(len(plain), style.opacity)
    if style.has_transparencies:
        opacity = opacity * (1.0 - rows[:, -1])
    return np.column_stack([plain, opacity])


def _repeated(colours: Array, times: int) -> Array:
    repeated: Array = np.repeat(colours, times, axis=0)
    return repeated


def _points(places: Array) -> Array:
    return places.reshape(-1, 3)


def _placed(points: Array, pose: Array) -> Array:
    """Return points of a frame in the one of its pose."""
    axis, w = pose[3:6], pose[6]
    turned = points + 2.0 * np.cross(axis, np.cross(axis, points) + w * points)
    return np.asarray(turned + pose[:3])


def _disc() -> Array:
    angles = np.linspace(0.0, 2.0 * np.pi, _DISC_CORNERS + 1)
    rim = 0.5 * np.column_stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)])
    triangles: Array = np.stack([np.zeros((_DISC_CORNERS, 3)), rim[:-1], rim[1:]], axis=1)
    return triangles.reshape(-1, 3)


def _cube() -> Array:
    faces = []
    for axis in range(3):
        for side in (-0.5, 0.5):
            flat = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
            faces.append(np.insert(flat, axis, side, axis=1))
    return np.concatenate(faces)


# The triangles of shapes of size 1, with the z axis as their normal.
_SHAPES: dict[str, Array] = {
    "triangle": np.array([[-0.5, -0.2887, 0.0], [0.5, -0.2887, 0.0], [0.0, 0.5774, 0.0]]),
    "quad": np.array(
        [[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.5, 0.5, 0.0], [-0.5, -0.5, 0.0], [0.5, 0.5, 0.0], [-0.5, 0.5, 0.0]]
    ),
    "disc": _disc(),
    "cube": _cube(),
}
