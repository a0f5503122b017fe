# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that find objects and get and set their poses."""

from __future__ import annotations

import contextlib
import math

from bubblesim._core import sensor_kind
from bubblesim.geometry import poses, rotations
from bubblesim.scene_state.handle_error import MAX_HANDLE
from bubblesim.scripting.api.checked_calls import refusal_warns, value_first
from bubblesim.scripting.api.kinds import (
    INTEGER,
    NO_OPTIONS,
    Handle,
    NameOrHandle,
    Options,
    Vector3,
    Vector4,
    Vector7,
    Vector12,
)
from bubblesim.scripting.api.sim.context import ApiContext

Vector = list[float]
WORLD = ApiContext.handle_world
HANDLE_ALL = ApiContext.handle_all
_LEAST_LENGTH = 0.1  # of a quaternion


class ObjectFunctions(ApiContext):
    """Positions in metres, quaternions x, y, z, w, Euler angles in radians (about the moving x, then y, then z)."""

    def getObject(self, path: str, options: Options = NO_OPTIONS) -> int:
        """Return the handle of the object at ``path``: '/a/b', './b', '../b', ':/b', '::/b'.

        '..' of an object at the top is the object itself, as for scripts of CoppeliaSim 4.7, which are below their
        object.

        Options: ``index`` selects one of several matches, ``noError`` returns -1 if there is none, ``proxy`` is the
        object where relative paths start.
        """
        unknown = options.keys() - {"index", "noError", "proxy"}
        if unknown:
            raise ValueError(f"getObject has no option '{min(unknown)}'; valid options: index, noError and proxy")
        start = self._resolve(options["proxy"]) if "proxy" in options else self._caller.object_handle
        is_from_parent = path == ".." or path.startswith("../")
        if is_from_parent and start >= 0 and self._tree.parent(start) < 0:
            path = path[1:]
        try:
            return self._shown(self._tree.find(path, start, INTEGER.convert(options.get("index", 0))))
        except LookupError:
            if options.get("noError"):
                return -1
            raise

    def getObjectHandle(self, name: NameOrHandle, options: Options = NO_OPTIONS) -> int:
        """Return the handle of the object with the name ``name``, anywhere in the scene (old style).

        For sim.handle_self: the object that the script is attached to. Copies are named 'name#0', 'name#1' ...: a
        script whose object has such a name finds the objects of its own copy, and 'name#' is the first object. With
        '@silentError' behind the name, -1 stands for an object that is not there.
        """
        if isinstance(name, int):
            return self._shown(self._resolve(name))
        name, _, mark = name.partition("@")
        if mark == "silentError":
            options = {**options, "noError": True}
        if name.startswith(("/", ".", ":")):
            return self.getObject(name, options)
        if not name:
            raise ValueError("sim.getObjectHandle: the name is empty")
        start = self._caller.object_handle
        own_name = (self._world.old_name(start) or str(self._world.name(start))) if start >= 0 else ""
        own_copy = own_name.partition("#")[1:]
        names = [name.removesuffix("#")] if "#" in name else [name + "".join(own_copy), name]
        for each in names:
            if (found := int(self._world.find_old_name(each))) >= 0:
                return self._shown(found)
        for each in names[:-1]:
            with contextlib.suppress(LookupError):
                return self._shown(self._tree.find(f"/{each}", start))
        return self.getObject(f"/{names[-1]}", options)

    def getObjectAssociatedWithScript(self, script: Handle) -> int:
        """Return the handle of the object that the script is attached to."""
        return self._resolve(script)

    def getObjectAlias(self, handle: Handle, option: int = -1) -> str:
        """Return the name of an object; ``option``: -1 bare, 0 with index, 1 short unique path, 2 full path, 5 path.

        3 bare, or 'name__handle__' if other objects have the same name; 4 always 'name__handle__'.
        """
        handle = self._resolve(handle)
        name = self._tree.name(handle)
        full = self._tree.path(handle)
        match option:
            case 0:
                return full.rpartition("/")[2]
            case 1:
                return self._tree.short_path(handle)
            case 2 | 5:
                return full
            case 3:
                return name if self._tree.short_path(handle) == f"/{name}" else f"{name}__{handle}__"
            case 4:
                return f"{name}__{handle}__"
            case _:
                return name

    def isHandle(self, handle: int, object_type: int = -1) -> bool:
        """Return whether there is an object with this handle."""
        return handle >= 0 and self._tree.contains(self._resolve(handle))

    def getObjects(self, index: int, object_type: int = HANDLE_ALL) -> int:
        """Return the handle of the ``index``-th object of a type in the scene, -1 if there are fewer."""
        found = self.getObjectsInTree(self.handle_scene, object_type)
        return found[index] if 0 <= index < len(found) else -1

    def getObjectName(self, handle: Handle) -> str:
        """Return the name of an object (old style): in an old scene the unique one, such as 'wheel#0'."""
        return self._world.old_name(self._resolve(handle)) or self.getObjectAlias(handle)

    def getObjectParent(self, handle: Handle) -> int:
        """Return the handle of the parent object, -1 at the top of the scene."""
        return self._shown(self._tree.parent(self._resolve(handle)))

    def getObjectChild(self, handle: Handle, index: int) -> int:
        """Return the handle of the ``index``-th child, -1 if there are fewer."""
        children = self._tree.children(handle if handle == WORLD else self._resolve(handle))
        return self._shown(children[index]) if 0 <= index < len(children) else -1

    def getObjectsInTree(self, base: Handle, object_type: int = HANDLE_ALL, options: int = 0) -> list[int]:
        """Return the handles of an object and all its descendants, or of the whole scene for sim.handle_scene.

        ``object_type`` (sim.object_joint_type ...) selects one type; options 1 excludes the object itself, 2 all except
        its direct children.
        """
        if base == self.handle_scene:
            roots = self._tree.children(WORLD)
            found = [
                handle for root in roots for handle in ([root] if options & 2 else self._tree.with_all_below(root))
            ]
        else:
            base = self._resolve(base)
            below = self._tree.children(base) if options & 2 else self._tree.with_all_below(base)[1:]
            found = below if options & 1 else [base, *below]
        wants_all = object_type == self.handle_all
        kept = [handle for handle in found if wants_all or self.getObjectType(handle) == object_type]
        return [self._shown(handle) for handle in kept]

    def getObjectType(self, handle: Handle) -> int:
        """Return sim.object_shape_type for models, links and shapes, and the type of joints and sensors.

        object_joint_type, object_proximitysensor_type, object_visionsensor_type for cameras, object_forcesensor_type
        for force-torque sensors, and object_dummy_type for dummies and other sensors. Objects of a file that have no
        effect here: object_camera_type, object_light_type, object_graph_type.
        """
        handle = self._sensor(handle)
        kind = self._tree.kind(handle)
        if kind == "sensor":
            sensors = {
                "proximity sensor": self.object_proximitysensor_type,
                "camera": self.object_visionsensor_type,
                "force-torque sensor": self.object_forcesensor_type,
            }
            return sensors.get(sensor_kind(self._simulation, handle), self.object_dummy_type)
        types = {
            "joint": self.object_joint_type,
            "model": self.object_shape_type,
            "link": self.object_shape_type,
            "shape": self.object_shape_type,
            "camera": self.object_camera_type,
            "light": self.object_light_type,
            "graph": self.object_graph_type,
        }
        return types.get(kind, self.object_dummy_type)

    def getObjectPose(self, handle: Handle, relative_to: Handle = WORLD) -> Vector:
        """Return [x, y, z, qx, qy, qz, qw], in the world or relative to another object (a joint: its moving frame)."""
        return self._pose(handle, relative_to)

    @refusal_warns
    @value_first
    def setObjectPose(self, handle: Handle, pose: Vector7, relative_to: Handle = WORLD) -> None:
        """Set the pose of a model, link, hinge or dummy. Also accepts the old order (handle, relative_to, pose)."""
        self._set_pose(handle, pose, relative_to)

    def getObjectPosition(self, handle: Handle, relative_to: Handle = WORLD) -> Vector:
        """Return [x, y, z] in metres."""
        return self._pose(handle, relative_to)[:3]

    @refusal_warns
    @value_first
    def setObjectPosition(self, handle: Handle, position: Vector3, relative_to: Handle = WORLD) -> None:
        """Set the position of a model, link, hinge or dummy. Accepts the old order (handle, relative_to, position)."""
        self._set_pose(handle, [*position, *self._pose(handle, relative_to)[3:]], relative_to)

    def getObjectQuaternion(self, handle: Handle, relative_to: Handle = WORLD) -> Vector:
        """Return [qx, qy, qz, qw]."""
        return self._pose(handle, relative_to)[3:]

    @refusal_warns
    @value_first
    def setObjectQuaternion(self, handle: Handle, quaternion: Vector4, relative_to: Handle = WORLD) -> None:
        """Set the orientation of a model, link, hinge or dummy. Accepts the old order (relative_to, quaternion)."""
        self._set_pose(handle, [*self._pose(handle, relative_to)[:3], *quaternion], relative_to)

    def getObjectOrientation(self, handle: Handle, relative_to: Handle = WORLD) -> Vector:
        """Return [alpha, beta, gamma] in radians."""
        return rotations.euler_angles(self._pose(handle, relative_to)[3:])

    @refusal_warns
    @value_first
    def setObjectOrientation(self, handle: Handle, angles: Vector3, relative_to: Handle = WORLD) -> None:
        """Set the Euler angles of a model, link, hinge, dummy. Accepts the old order (handle, relative_to, angles)."""
        position = self._pose(handle, relative_to)[:3]
        self._set_pose(handle, [*position, *rotations.quaternion_of_euler(angles)], relative_to)

    @refusal_warns
    @value_first
    def setObjectMatrix(self, handle: Handle, matrix: Vector12, relative_to: Handle = WORLD) -> None:
        """Set the pose of a model, link, hinge or dummy by a matrix of 12 numbers. Also accepts the old order."""
        self._set_pose(handle, poses.of_matrix(matrix), relative_to)

    def getObjectMatrix(self, handle: Handle, relative_to: Handle = WORLD) -> Vector:
        """Return the upper three rows of the transformation matrix, 12 numbers row by row."""
        return rotations.matrix_of_pose(self._pose(handle, relative_to))

    def getObjectVelocity(self, handle: Handle) -> tuple[Vector, Vector]:
        """Return the linear (m/s) and angular (rad/s) velocity in world axes."""
        linear, angular = self._world.velocity(self._resolve(handle))
        return list(linear), list(angular)

    def _pose(self, handle: int, relative_to: int) -> Vector:
        if relative_to == WORLD and handle < self.handleflag_reljointbaseframe:  # most calls
            return self._tree.pose(self._resolve(handle))
        handle, relative_to = self._without_flag(handle, relative_to)
        handle = self._resolve(handle)
        joint = self._joint_with_base_frame(relative_to)
        if joint >= 0:
            return poses.multiply(self._motion_of(joint), self._tree.pose_in(handle, joint))
        frame = self._frame(handle, relative_to)
        return self._tree.pose(handle) if frame is None else self._tree.pose_in(handle, frame)

    def _without_flag(self, handle: int, relative_to: int) -> tuple[int, int]:
        """Move sim.handleflag_reljointbaseframe from the handle of the object, where old scripts add it."""
        if not self._has_flag(handle):
            return handle, relative_to
        flag = self.handleflag_reljointbaseframe
        return handle & ~flag, relative_to | flag if relative_to >= 0 else relative_to

    def _joint_with_base_frame(self, relative_to: int) -> int:
        """Return the joint of a handle with sim.handleflag_reljointbaseframe; -1 for other handles."""
        if not self._has_flag(relative_to):
            return -1
        return self._resolve(relative_to & ~self.handleflag_reljointbaseframe)

    def _has_flag(self, handle: int) -> bool:
        """Return whether a handle has sim.handleflag_reljointbaseframe added."""
        if not 0 <= handle <= MAX_HANDLE or not handle & self.handleflag_reljointbaseframe:
            return False
        return not self._tree.contains(handle)

    def _motion_of(self, joint: int) -> Vector:
        """Return the moving frame of a joint in the frame of its base; the identity for what is no joint that moves."""
        if self._tree.kind(joint) != "joint" or str(self._world.joint_type(joint)) == "fixed":
            return list(poses.IDENTITY)
        position = float(self._world.joint_position(joint))
        if str(self._world.joint_type(joint)) == "prismatic":
            return [0.0, 0.0, position, 0.0, 0.0, 0.0, 1.0]
        return [0.0, 0.0, 0.0, 0.0, 0.0, math.sin(position / 2), math.cos(position / 2)]

    def _frame(self, handle: Handle, relative_to: int) -> int | None:
        """Return the object with the reference frame; None for the world's."""
        if relative_to == self.handle_world:
            return None
        if relative_to == self.handle_parent:
            parent = self._tree.parent(handle)
            return None if parent < 0 else parent
        return self._resolve(relative_to)

    def _set_pose(self, handle: Handle, pose: Vector, relative_to: int) -> None:
        handle, relative_to = self._without_flag(handle, relative_to)
        handle = self._resolve(handle)
        length = math.hypot(*pose[3:])
        if math.isfinite(length) and length > _LEAST_LENGTH:  # numbers that scripts have computed
            pose = [*pose[:3], *(number / length for number in pose[3:])]
        joint = self._joint_with_base_frame(relative_to)
        if joint >= 0:
            self._tree.set_pose(handle, poses.multiply(poses.inverse(self._motion_of(joint)), pose), joint)
            return
        frame = self._frame(handle, relative_to)
        self._tree.set_pose(handle, pose, WORLD if frame is None else frame)
