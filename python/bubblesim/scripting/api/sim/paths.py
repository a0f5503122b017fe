# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for paths."""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping
from typing import Any

from bubblesim.geometry import poses, rotations
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Handle, Numbers, Vector3
from bubblesim.scripting.api.sim import path_points
from bubblesim.scripting.api.sim.objects import ObjectFunctions
from bubblesim.scripting.api.waiting_functions import Waiting, waits

_CLOSED = 2  # options of createPath
_POSE = [path_points.LINEAR] * 3 + [path_points.QUATERNION] * 4
_LINE: Mapping[str, Any] = {"type": "linear"}
_UP = [0.0, 0.0, 1.0]


class PathFunctions(ObjectFunctions):
    """A path is a dummy with its points in the custom data 'PATH' (7 numbers each, packed doubles, in its frame); or a
    list of configurations, one after the other, with the lengths up to each of them."""

    def createPath(
        self,
        points: Any,
        options: Any = 0,
        subdivision: Any = 100,
        smoothness: Any = 1.0,
        orientation_mode: int = 0,
        up: Vector3 = _UP,
    ) -> int:
        """Create a path and return its handle: ``points`` are poses, 7 numbers each. Options: 2 closed. It has
        ``subdivision`` points on a curve, straight for ``smoothness`` 0; orientation mode 0 turns x along the path.
        The old form, with attributes in place of the points and parameters and colours for drawings, creates a path
        without points, for insertPathCtrlPoints."""
        if isinstance(points, int):
            return self._empty_path()
        configs = path_points.rows([float(number) for number in points], 7)
        closed = bool(int(options) & _CLOSED)
        made = self._smoothed(configs, max(2, int(subdivision)), float(smoothness), closed=closed)
        if orientation_mode == 0:
            _turn_along(made, up)
        handle = self._empty_path()
        self._write_points(handle, "PATHCTRLPTS", configs)
        self._write_points(handle, "PATH", made)
        return handle

    def _empty_path(self) -> int:
        return self._caller.shared.dummies.create(self._world, "Path", 0.01, temporary=not self._is_stopped()).handle

    def getPathLengths(self, path: Numbers, size: int, distance: Any = None) -> tuple[list[float], float]:
        """Return the lengths of a path up to each configuration of ``size`` numbers, and its length. ``distance`` is a
        function that returns that of two configurations."""
        between = distance if callable(distance) and not self._caller.is_remote else path_points.distance
        along = path_points.lengths(path_points.rows(path, size), between)
        return along, along[-1]

    def getPathInterpolatedConfig(
        self, path: Numbers, lengths: Numbers, at: float, method: Any = None, types: Any = None
    ) -> list[float]:
        """Return the configuration at a length along a path. ``method``: {type = 'linear'} or 'quadraticBezier' with
        ``strength`` and ``forceOpen``; ``types`` of the numbers: 0 linear, 1 cyclic, 2 part of a quaternion."""
        configs = path_points.rows(path, len(path) // max(1, len(lengths)))
        kinds = list(types) if isinstance(types, list | tuple) else []
        how = method if isinstance(method, Mapping) else _LINE
        if how.get("type", "linear") == "linear":
            return path_points.linear(configs, lengths, at, kinds)
        closed = not how.get("forceOpen") and path_points.distance(configs[0], configs[-1]) < 1e-9
        return path_points.rounded(configs, lengths, at, kinds, float(how.get("strength", 1.0)), closed=closed)

    def getClosestPosOnPath(self, path: Numbers, lengths: Numbers, point: Numbers) -> float:
        """Return the length along a path to the place nearest to a point, by x, y and z."""
        configs = path_points.rows(path, len(path) // max(1, len(lengths)))
        return path_points.nearest(configs, lengths, point)

    def resamplePath(
        self, path: Numbers, lengths: Numbers, count: int, method: Any = None, types: Any = None
    ) -> list[float]:
        """Return a path with ``count`` configurations at equal distances. See getPathInterpolatedConfig."""
        places = [lengths[-1] * number / max(1, count - 1) for number in range(count)]
        return [x for at in places for x in self.getPathInterpolatedConfig(path, lengths, at, method, types)]

    def getPathLength(self, path: Handle) -> float:
        """Return the length of a path (old name)."""
        return self._path(path)[1][-1]

    def getPositionOnPath(self, path: Handle, share: float) -> list[float]:
        """Return x, y, z in the world at a share, 0 to 1, of the length of a path (old style)."""
        return self._pose_on(path, share)[:3]

    def getOrientationOnPath(self, path: Handle, share: float) -> list[float]:
        """Return Euler angles in the world at a share, 0 to 1, of the length of a path (old style)."""
        return rotations.euler_angles(self._pose_on(path, share)[3:])

    def getPathPosition(self, path: Handle) -> float:
        """Return the length along a path that was set with setPathPosition (old name)."""
        handle = self._resolve(path)
        self._path(path)
        return float(self._caller.shared.settings.get((float, f"position on path {handle}"), 0.0))

    def setPathPosition(self, path: Handle, position: float) -> int:
        """Keep a length along a path (old name); return 1."""
        self._path(path)
        self._caller.shared.settings[float, f"position on path {self._resolve(path)}"] = position
        return 1

    @differs("a path moves its position at this velocity; here scripts call setPathPosition")
    def setPathTargetNominalVelocity(self, path: Handle, velocity: float) -> int:
        """Keep the velocity of a path (old name), which has no effect; return 1."""
        self._path(path)
        return 1

    def getClosestPositionOnPath(self, path: Handle, point: Vector3) -> float:
        """Return the share, 0 to 1, of the length of a path at the place nearest to a point in the world (old)."""
        configs, along = self._path(path)
        local = poses.transform(poses.inverse(self._tree.pose(self._resolve(path))), point)
        return path_points.nearest(configs, along, local) / along[-1] if along[-1] else 0.0

    def insertPathCtrlPoints(self, path: Handle, options: int, start: int, count: int, points: Numbers) -> int:
        """Insert points into a path, each x, y, z, Euler angles and more numbers (old style); return 1."""
        handle = self._resolve(path)
        size = len(points) // max(1, count)
        if size < 3:
            raise ValueError(f"{count} points need 3 numbers or more each, found {len(points)}")
        known = self._data(handle, "PATHCTRLPTS")
        configs = path_points.rows(_unpacked(known), 7) if known else []
        for number in range(count):
            values = points[size * number : size * (number + 1)]
            angles = values[3:6] if len(values) >= 6 else [0.0, 0.0, 0.0]
            configs.insert(start + number, [*values[:3], *rotations.quaternion_of_euler(angles)])
        self._write_points(handle, "PATHCTRLPTS", configs)
        self._write_points(handle, "PATH", configs)
        return 1

    @waits
    def followPath(
        self,
        handle: Handle,
        path: Any,
        what: int,
        start: float,
        velocity: float,
        acceleration: float = 0.0,
    ) -> Waiting:
        """Move an object along a path at a velocity in m/s, from a share, 0 to 1, of its length (old style); return the
        time left. ``what``: 1 position, 2 orientation, 3 both. ``path`` is a handle or a list of poses."""
        if isinstance(path, list | tuple):
            configs = path_points.rows([float(number) for number in path], 7)
            along, frame = path_points.lengths(configs, _in_space), poses.IDENTITY
        else:
            (configs, along), frame = self._path(int(path)), self._tree.pose(self._resolve(int(path)))
        if not velocity > 0:
            raise ValueError(f"the velocity must be positive, found {velocity:g}")
        at, speed, step = start * along[-1], velocity if acceleration <= 0 else 0.0, float(self._simulation.time_step)
        while at < along[-1]:
            speed = min(velocity, speed + acceleration * step) if acceleration > 0 else velocity
            at += speed * step
            pose = poses.multiply(frame, path_points.linear(configs, along, at, _POSE))
            now = self.getObjectPose(handle)
            self.setObjectPose(handle, [*(pose[:3] if what & 1 else now[:3]), *(pose[3:] if what & 2 else now[3:])])
            if at < along[-1]:
                yield
        return (along[-1] - at) / speed if speed else 0.0

    def _smoothed(
        self, configs: list[list[float]], count: int, smoothness: float, *, closed: bool
    ) -> list[list[float]]:
        whole = [*configs, configs[0]] if closed and path_points.distance(configs[0], configs[-1]) > 1e-9 else configs
        along = path_points.lengths(whole, _in_space)
        places = [along[-1] * number / (count - 1) for number in range(count)]
        if smoothness <= 0 or len(whole) < 3:
            return [path_points.linear(whole, along, at, _POSE) for at in places]
        return [path_points.rounded(whole, along, at, _POSE, smoothness, closed=closed) for at in places]

    def _write_points(self, handle: int, tag: str, configs: list[list[float]]) -> None:
        numbers = [number for config in configs for number in config]
        self._caller.shared.custom_data[handle, tag] = struct.pack(f"<{len(numbers)}d", *numbers)

    def _data(self, handle: int, tag: str) -> Any:
        """Return what a script has attached to an object, or the scene's file."""
        data = self._caller.shared.custom_data.get((handle, tag))
        return self._world.file_data(handle).get(tag) if data is None else data

    def _path(self, path: int) -> tuple[list[list[float]], list[float]]:
        """Return the poses of a path in its frame, and the lengths up to each."""
        handle = self._resolve(path)
        self._tree.kind(handle)  # raises
        data = self._data(handle, "PATH")
        if data is None:
            raise ValueError(f"{self._tree.short_path(handle)} is not a path: it has no custom data 'PATH'")
        configs = path_points.rows(_unpacked(data), 7)
        return configs, path_points.lengths(configs, _in_space)

    def _pose_on(self, path: int, share: float) -> list[float]:
        configs, along = self._path(path)
        local = path_points.linear(configs, along, share * along[-1], _POSE)
        return poses.multiply(self._tree.pose(self._resolve(path)), local)


def _in_space(a: list[float], b: list[float]) -> float:
    return math.dist(a[:3], b[:3])


def _unpacked(data: Any) -> list[float]:
    raw = data.encode("latin-1") if isinstance(data, str) else bytes(data)
    return list(struct.unpack(f"<{len(raw) // 8}d", raw[: len(raw) // 8 * 8]))


def _turn_along(configs: list[list[float]], up: list[float]) -> None:
    """Turn each pose so that x is along the path, and z as near to ``up`` as possible."""
    for number, config in enumerate(configs):
        a, b = configs[max(number - 1, 0)], configs[min(number + 1, len(configs) - 1)]
        x = _unit([q - p for p, q in zip(a[:3], b[:3], strict=True)])
        y = _unit(_cross(up, x)) if x else None
        if x and y:
            z = _cross(x, y)
            matrix = [value for i in range(3) for value in (x[i], y[i], z[i], 0.0)]
            config[3:] = poses.of_matrix(matrix)[3:]


def _unit(vector: list[float]) -> list[float]:
    """Return a vector of length 1; an empty list for 0."""
    size = math.hypot(*vector)
    return [value / size for value in vector] if size > 1e-9 else []


def _cross(a: list[float], b: list[float]) -> list[float]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
