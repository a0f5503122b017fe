# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that find objects and read and set their poses."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bubblesim.scripting import rotations
from bubblesim.scripting.context import ApiContext, as_handle, as_numbers

Vector = list[float]
WORLD = ApiContext.handle_world


class ObjectFunctions(ApiContext):
    """Positions in metres, quaternions x, y, z, w, Euler angles in radians (about the moving x, then y, then z)."""

    def getObject(self, path: str, options: Mapping[str, Any] | None = None) -> int:
        """Handle of the object at ``path``: '/a/b', './b', '../b', ':/b', '::/b'.

        Options: ``index`` picks one of several matches, ``noError`` returns -1 when there is none, ``proxy`` is the
        object that relative paths start at.
        """
        options = options or {}
        unknown = options.keys() - {"index", "noError", "proxy"}
        if unknown:
            raise ValueError(f"getObject has no option '{min(unknown)}'; it has index, noError and proxy")
        if not isinstance(path, str):
            raise TypeError(f"getObject takes a path such as '/Ball', found {type(path).__name__}")
        start = self._resolve(options.get("proxy", self._script.object_handle))
        try:
            return int(self._world.find(path, start, as_handle(options.get("index", 0))))
        except LookupError:
            if options.get("noError"):
                return -1
            raise

    def getObjectHandle(self, name: str) -> int:
        """Handle of the object called ``name``, wherever it is (old style)."""
        path = name if name.startswith(("/", ".", ":")) else f"/{name}"
        return int(self._world.find(path, self._script.object_handle))

    def getObjectAssociatedWithScript(self, script: int) -> int:
        """Handle of the object that the script is attached to."""
        return self._resolve(script)

    def getObjectAlias(self, handle: int, option: int = -1) -> str:
        """Name of an object: -1 bare, 0 with index, 1 short unique path, 2 full path, 3 and 4 with handle, 5 path."""
        handle = self._resolve(handle)
        name = str(self._world.name(handle))
        full = str(self._world.path(handle))
        match option:
            case 0:
                return full.rpartition("/")[2]
            case 1:
                return str(self._world.short_path(handle))
            case 2 | 5:
                return full
            case 3:
                return name if self._world.short_path(handle) == f"/{name}" else f"{name}__{handle}__"
            case 4:
                return f"{name}__{handle}__"
            case _:
                return name

    def getObjectName(self, handle: int) -> str:
        """Name of an object (old style)."""
        return self.getObjectAlias(handle)

    def getObjectParent(self, handle: int) -> int:
        """Handle of the object above, -1 at the top of the scene."""
        return int(self._world.parent(self._resolve(handle)))

    def getObjectChild(self, handle: int, index: int) -> int:
        """Handle of the ``index``-th object below, -1 when there are fewer."""
        children = self._world.children(self._resolve(handle))
        return int(children[index]) if 0 <= index < len(children) else -1

    def getObjectType(self, handle: int) -> int:
        """sim.object_shape_type, object_joint_type or object_proximitysensor_type."""
        kinds = {"joint": self.object_joint_type, "sensor": self.object_proximitysensor_type}
        return kinds.get(self._world.kind(self._resolve(handle)), self.object_shape_type)

    def getObjectPose(self, handle: int, relative_to: int = WORLD) -> Vector:
        """[x, y, z, qx, qy, qz, qw], in the world or relative to another object (a joint: its moving frame)."""
        handle = self._resolve(handle)
        frame = self._frame(handle, relative_to)
        pose = self._world.pose(handle) if frame is None else self._world.pose_in(handle, frame)
        return list(pose)

    def setObjectPose(self, handle: int, pose: Any, relative_to: Any = WORLD) -> None:
        """Put a model or link somewhere else. Also takes the old order (handle, relative_to, pose)."""
        pose, relative_to = _in_new_order(pose, relative_to)
        self._set_pose(handle, as_numbers(pose, 7, "setObjectPose"), relative_to)

    def getObjectPosition(self, handle: int, relative_to: int = WORLD) -> Vector:
        """[x, y, z] in metres."""
        return self.getObjectPose(handle, relative_to)[:3]

    def setObjectPosition(self, handle: int, position: Any, relative_to: Any = WORLD) -> None:
        """Move a model or link. Also takes the old order (handle, relative_to, position)."""
        position, relative_to = _in_new_order(position, relative_to)
        moved = as_numbers(position, 3, "setObjectPosition")
        self._set_pose(handle, [*moved, *self.getObjectQuaternion(handle, relative_to)], relative_to)

    def getObjectQuaternion(self, handle: int, relative_to: int = WORLD) -> Vector:
        """[qx, qy, qz, qw]."""
        return self.getObjectPose(handle, relative_to)[3:]

    def setObjectQuaternion(self, handle: int, quaternion: Any, relative_to: Any = WORLD) -> None:
        """Turn a model or link. Also takes the old order (handle, relative_to, quaternion)."""
        quaternion, relative_to = _in_new_order(quaternion, relative_to)
        turned = as_numbers(quaternion, 4, "setObjectQuaternion")
        self._set_pose(handle, [*self.getObjectPosition(handle, relative_to), *turned], relative_to)

    def getObjectOrientation(self, handle: int, relative_to: int = WORLD) -> Vector:
        """[alpha, beta, gamma] in radians."""
        return rotations.euler_angles(self.getObjectQuaternion(handle, relative_to))

    def setObjectOrientation(self, handle: int, angles: Any, relative_to: Any = WORLD) -> None:
        """Turn a model or link to Euler angles. Also takes the old order (handle, relative_to, angles)."""
        angles, relative_to = _in_new_order(angles, relative_to)
        turned = rotations.quaternion_of_euler(as_numbers(angles, 3, "setObjectOrientation"))
        self.setObjectQuaternion(handle, turned, relative_to)

    def getObjectMatrix(self, handle: int, relative_to: int = WORLD) -> Vector:
        """The upper three rows of the transformation matrix, 12 numbers row by row."""
        return rotations.matrix_of_pose(self.getObjectPose(handle, relative_to))

    def getObjectVelocity(self, handle: int) -> tuple[Vector, Vector]:
        """Linear (m/s) and angular (rad/s) velocity in the world's axes."""
        linear, angular = self._world.velocity(self._resolve(handle))
        return list(linear), list(angular)

    def _frame(self, handle: int, relative_to: int) -> int | None:
        """The object whose frame is meant; None for the world's."""
        reference = as_handle(relative_to)
        if reference == self.handle_world:
            return None
        if reference == self.handle_parent:
            parent = int(self._world.parent(handle))
            return None if parent < 0 else parent
        return self._resolve(reference)

    def _set_pose(self, handle: int, pose: Vector, relative_to: int) -> None:
        handle = self._resolve(handle)
        frame = self._frame(handle, relative_to)
        if frame is None:
            self._world.set_pose(handle, pose)
        else:
            self._world.set_pose_in(handle, pose, frame)


def _in_new_order(value: Any, relative_to: Any) -> tuple[Any, int]:
    """Old scripts give the reference object before the value, new ones after it."""
    return (
        (relative_to, value) if hasattr(value, "__index__") and not hasattr(value, "__len__") else (value, relative_to)
    )
