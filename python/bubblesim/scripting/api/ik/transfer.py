# SPDX-License-Identifier: BSD-3-Clause
"""`simIK` functions that copy mechanisms of the scene, and positions from and to it."""

from __future__ import annotations

import math
from collections.abc import Iterator

from bubblesim._core import MotorMode
from bubblesim.geometry import poses
from bubblesim.scripting.api.ik.context import IkContext
from bubblesim.scripting.api.ik.environment import PRISMATIC, REVOLUTE, SPHERICAL, WORLD, Element, Environment
from bubblesim.scripting.api.ik.solver import SUCCESS
from bubblesim.scripting.api.kinds import Integers

_TYPES = {"prismatic": PRISMATIC, "ball": SPHERICAL}


class TransferFunctions(IkContext):
    """In the scene, joints that lead from a base to a tip are found in the tree or, where joints and links are side by
    side, by the links that they connect."""

    def addElementFromScene(
        self, environment: int, group: int, base: int, tip: int, target: int, constraints: int
    ) -> tuple[int, dict[int, int], dict[int, int]]:
        """Copy base, joints, tip and target of the scene, and add an element; return its handle, and the objects of the
        environment by those of the scene, and the reverse."""
        found = self._environment(environment)
        own_tip = self._copy_chain(found, base, tip)
        own_base = found.scene_objects.get(base, WORLD)
        if target >= 0:
            found.at(own_tip).target = self._copy_frame(found, target, WORLD if base < 0 else own_base, moves=False)
        elements = self._group(environment, group).elements
        elements.append(Element(own_tip, own_base, own_base, constraints))
        to_own = dict(found.scene_objects)
        return len(elements) - 1, to_own, {own: scene for scene, own in to_own.items()}

    def syncFromScene(self, environment: int, groups: Integers) -> None:
        """Take poses of dummies and positions of joints from the scene."""
        self._take_from_scene(environment)

    def syncToScene(self, environment: int, groups: Integers) -> None:
        """Give positions of joints to the scene: joints that control their position get a target, others move at
        once."""
        self._give_to_scene(environment)

    def syncFromSim(self, environment: int, groups: Integers) -> None:
        """Take positions from the scene (old name of syncFromScene)."""
        self._take_from_scene(environment)

    def syncToSim(self, environment: int, groups: Integers) -> None:
        """Give positions to the scene (old name of syncToScene)."""
        self._give_to_scene(environment)

    def applySceneToEnvironment(self, environment: int, group: int) -> None:
        """Take positions from the scene (old style)."""
        self._take_from_scene(environment)

    def applyEnvironmentToScene(self, environment: int, group: int, only_success: bool = False) -> int:
        """Take positions from the scene, handle a group, and give positions to the scene (old style); return the result
        of the group. ``only_success``: positions are given only if it is simIK.result_success."""
        self._take_from_scene(environment)
        result, _, _ = self._solver(environment).handle(self._group(environment, group))
        if result == SUCCESS or not only_success:
            self._give_to_scene(environment)
        return result

    def _take_from_scene(self, environment: int) -> None:
        found = self._environment(environment)
        for scene, own in found.scene_objects.items():
            each = found.at(own)
            if each.is_joint:
                each.position = float(self._world.joint_position(scene))
        for scene, own in found.scene_objects.items():
            each = found.at(own)
            if not each.is_joint and each.parent == WORLD:
                pose = self._tree.pose(scene)
                if each.pose != pose:
                    found.set_pose(own, pose)

    def _give_to_scene(self, environment: int) -> None:
        found = self._environment(environment)
        for scene, own in found.scene_objects.items():
            each = found.at(own)
            if not each.is_joint or each.joint_type == SPHERICAL or not self._world.contains(scene):
                continue
            if self._world.motor_mode(scene) == MotorMode.POSITION:
                self._world.set_target_position(scene, each.position)
            else:
                self._world.set_joint_position(scene, each.position)

    def _copy_chain(self, found: Environment, base: int, tip: int) -> int:
        """Copy the joints between a base and a tip, and both; return the tip."""
        joints = list(self._joints_between(base, tip))
        parent = WORLD
        if base >= 0:
            parent = self._copy_frame(found, base, WORLD, moves=False)
        for joint in reversed(joints):
            parent = self._copy_joint(found, joint, parent)
        return self._copy_frame(found, tip, parent, moves=True)

    def _copy_joint(self, found: Environment, joint: int, parent: int) -> int:
        if joint in found.scene_objects:
            return found.scene_objects[joint]
        kind = _TYPES.get(str(self._world.joint_type(joint)), REVOLUTE)
        made = found.add(self._tree.name(joint), is_joint=True, joint_type=kind)
        made.position = float(self._world.joint_position(joint))
        made.parent = parent
        low, high = self._world.joint_limits(joint)
        if math.isfinite(high - low):
            made.cyclic, made.low, made.high = False, float(low), float(high)
        found.set_pose(made.handle, poses.multiply(self._moving_frame(joint), poses.inverse(found.moved(made))))
        found.scene_objects[joint] = made.handle
        return made.handle

    def _moving_frame(self, joint: int) -> list[float]:
        """Return the moving frame of a joint in the world: poses relative to a joint are in it."""
        other = self._tree.children(WORLD)[0]
        return poses.multiply(self._tree.pose(other), poses.inverse(self._tree.pose_in(other, joint)))

    def _copy_frame(self, found: Environment, handle: int, parent: int, *, moves: bool) -> int:
        """Copy an object as a dummy; one that does not move with joints follows the scene."""
        if handle in found.scene_objects:
            return found.scene_objects[handle]
        made = found.add(self._tree.name(handle), is_joint=False)
        if moves:
            made.parent = parent
        found.set_pose(made.handle, self._tree.pose(handle))
        found.scene_objects[handle] = made.handle
        return made.handle

    def _joints_between(self, base: int, tip: int) -> Iterator[int]:
        """Yield the joints from a tip up to a base, by the tree, and by links where the tree has none."""
        way = []
        each = tip
        while (each := self._tree.parent(each)) >= 0 and each != base:
            way.append(each)
        in_tree = [each for each in way if self._is_joint(each)]
        if in_tree and (each == base or base < 0):
            yield from in_tree
            return
        yield from self._joints_by_links(base, tip)

    def _joints_by_links(self, base: int, tip: int) -> Iterator[int]:
        link, end = self._link_of(tip), self._link_of(base) if base >= 0 else -1
        model = self._tree.model(link) if link >= 0 else -1
        if model < 0:
            return
        above: dict[int, tuple[int, int]] = {}  # by child: joint and parent link
        for joint in self._world.parts(model, "joint"):
            parent, child = (int(each) for each in self._world.joint_links(joint))
            above[child] = int(joint), parent
        seen: set[int] = set()
        while link != end and link in above and link not in seen:
            seen.add(link)
            joint, link = above[link]
            if self._is_joint(joint):
                yield joint

    def _is_joint(self, handle: int) -> bool:
        return self._tree.kind(handle) == "joint" and str(self._world.joint_type(handle)) != "fixed"

    def _link_of(self, handle: int) -> int:
        """Return the link that carries an object, or its first one."""
        kind = self._tree.kind(handle)
        if kind == "link":
            return handle
        if kind == "model":
            return int(self._world.parts(handle, "link")[0])
        if kind == "joint":
            return int(self._world.joint_links(handle)[1])
        if kind == "sensor":
            return int(self._world.carrier(handle))
        return int(self._world.frame_link(handle))
