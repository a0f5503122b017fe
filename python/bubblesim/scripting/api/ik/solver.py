# SPDX-License-Identifier: BSD-3-Clause
"""Solves groups: pseudo-inverse, or damped least squares (Wampler 1986, Nakamura and Hanafusa 1986), with limits of
joints.

The damping of a search for configurations adapts by Levenberg's and Marquardt's rule.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from bubblesim.geometry import poses, rotations
from bubblesim.scripting.api.ik.chains import Array, Chain
from bubblesim.scripting.api.ik.environment import (
    ALL,
    ALPHA_BETA,
    GAMMA,
    PRISMATIC,
    WORLD,
    Element,
    Environment,
    Group,
    IkObject,
    X,
    Y,
    Z,
)

NOT_PERFORMED, SUCCESS, FAIL = 0, 1, 2
PSEUDO_INVERSE, DAMPED, TRANSPOSE, UNDAMPED = 0, 1, 2, 3
_IGNORE_STEPS, _RESTORE_LINEAR, _RESTORE_ANGULAR = 2, 4, 8
NOT_INVERTIBLE, NOT_WITHIN_TOLERANCE = 2, 16  # bits of the reason
_SEARCH_ITERATIONS = 60
_QUICK_STARTS = 10
_SMALLEST = 1e-12


class Solver:
    """Keeps the chains of an environment."""

    def __init__(self, environment: Environment) -> None:
        """Solve the groups of an environment."""
        self._environment = environment
        self._chains: dict[tuple[int, int], Chain] = {}
        self._structure = -1

    def errors(self, group: Group) -> tuple[Array, Array, list[IkObject], Array]:
        """Return the weighted errors of all constraints, their Jacobian, its joints, and the linear (m) and angular
        (rad) error of each element."""
        elements = [each for each in group.elements if each.is_enabled and self._target(each) >= 0]
        parts = [self._element(each) for each in elements]
        joints: list[IkObject] = []
        for _, _, of_chain, _ in parts:
            joints += [joint for joint in of_chain if joint not in joints]
        column = {joint.handle: number for number, joint in enumerate(joints)}
        error = np.concatenate([part[0] for part in parts]) if parts else np.zeros(0)
        jacobian = np.zeros((len(error), len(joints)))
        row = 0
        for one_error, one_jacobian, of_chain, _ in parts:
            jacobian[row : row + len(one_error), [column[joint.handle] for joint in of_chain]] = one_jacobian
            row += len(one_error)
        return error, jacobian, joints, np.array([part[3] for part in parts]).reshape(-1, 2)

    def handle(self, group: Group) -> tuple[int, int, list[float]]:
        """Carry out the iterations of a group; return the result, the reason of a failure and the linear and angular
        error that are left."""
        self._environment.follow_dependencies()
        before = {handle: each.position for handle, each in self._environment.objects.items() if each.is_joint}
        for _ in range(max(1, group.iterations)):
            error, jacobian, joints, left = self.errors(group)
            if not joints:
                return NOT_PERFORMED, 1, [0.0, 0.0]
            if self._is_precise(group, left):
                break
            step = _step(group, error, jacobian, joints)
            if step is None:
                return FAIL, NOT_INVERTIBLE, [float(left[:, 0].max()), float(left[:, 1].max())]
            _move(joints, step, limited=not group.flags & _IGNORE_STEPS)
            self._environment.follow_dependencies()
        _, _, _, left = self.errors(group)
        precision = [float(left[:, 0].max()), float(left[:, 1].max())]
        if self._is_precise(group, left):
            return SUCCESS, 0, precision
        limits = np.array([each.precision for each in self._enabled(group)])
        bad = np.any(left > limits, axis=0)
        if (group.flags & _RESTORE_LINEAR and bad[0]) or (group.flags & _RESTORE_ANGULAR and bad[1]):
            for handle, position in before.items():
                self._environment.objects[handle].position = position
        return FAIL, NOT_WITHIN_TOLERANCE, precision

    def search(
        self,
        group: Group,
        joints: list[IkObject],
        seconds: float,
        accept: Callable[[list[float]], bool],
        random: np.random.Generator,
        *,
        most: int = 1,
    ) -> list[list[float]]:
        """Return configurations of ``joints`` that fulfil a group exactly, the first one from where the joints are, the
        others from random ones; at most ``most`` different ones. The joints stay where they are."""
        before = [joint.position for joint in joints]
        found: list[list[float]] = []
        end = time.monotonic() + seconds
        starts = 0
        while not starts or (time.monotonic() < end and len(found) < most):
            if starts:
                for joint in joints:
                    joint.position = float(random.uniform(*_interval(joint)))
            starts += 1
            if self._reach(group, joints, thorough=starts > _QUICK_STARTS):
                config = [joint.position for joint in joints]
                is_new = all(max(abs(a - b) for a, b in zip(config, each, strict=True)) > 1e-3 for each in found)
                if is_new and accept(config):
                    found.append(config)
        for joint, position in zip(joints, before, strict=True):
            joint.position = position
        return found

    def _reach(self, group: Group, joints: list[IkObject], *, thorough: bool) -> bool:
        """Move the joints from where they are until the errors of a group vanish; return whether they do.

        A single tip is reached by the search of KDL, which is faster; where it leaves the limits of joints, or cannot
        be used, by the solver here. ``thorough``: also where it finds nothing.
        """
        chain = self._single_chain(group, joints)
        if chain is None:
            return self.converge(group)
        element = self._enabled(group)[0]
        base = self._environment.pose(element.base, moved=True)
        goal = poses.multiply(poses.inverse(base), self._environment.pose(self._target(element)))
        found = chain.find(goal, with_orientation=element.constraints == ALL)
        if found is None:
            return thorough and self.converge(group)
        before = [joint.position for joint in chain.joints]
        for joint, position in zip(chain.joints, found, strict=True):
            joint.position = _nearest_turn(joint, position)
            if not joint.cyclic and not joint.low - 1e-9 <= joint.position <= joint.high + 1e-9:
                for each, start in zip(chain.joints, before, strict=True):
                    each.position = start
                return self.converge(group)
        _, _, _, left = self.errors(group)
        return bool((left <= self._exact(group)).all())

    def _single_chain(self, group: Group, joints: list[IkObject]) -> Chain | None:
        """Return the chain of a group with one tip, whose position, or pose, is to be reached by the given joints in a
        base and with a target that they do not move; None for other groups."""
        elements = self._enabled(group)
        if len(elements) != 1 or elements[0].constraints not in (ALL, X | Y | Z):
            return None
        element = elements[0]
        chain = self._chain(element.base, element.tip)
        if chain.has_dependent_joints or not chain.joints or any(joint not in joints for joint in chain.joints):
            return None
        environment = self._environment
        frames = [self._target(element), *([element.base] if element.base != WORLD else [])]
        for frame in frames:
            if any(above in chain.joints for above in environment.above(frame)):
                return None
        return chain

    def converge(self, group: Group, iterations: int = _SEARCH_ITERATIONS) -> bool:
        """Move the joints from where they are until the errors of a group vanish; return whether they do."""
        damping = 1e-2
        error, jacobian, joints, left = self.errors(group)
        if not joints:
            return False
        cost = float(error @ error)
        for _ in range(iterations):
            if cost < _SMALLEST * _SMALLEST:
                break
            free = _free(joints, jacobian.T @ error)
            part = jacobian[:, free]
            system = part.T @ part + damping * damping * np.eye(len(free))
            step = np.zeros(len(joints))
            step[free] = np.linalg.solve(system, part.T @ error)
            before = [joint.position for joint in joints]
            _move(joints, step, limited=False)
            self._environment.follow_dependencies()
            new_error, new_jacobian, _, new_left = self.errors(group)
            new_cost = float(new_error @ new_error)
            if new_cost < cost:
                gain = new_cost / cost
                error, jacobian, left, cost = new_error, new_jacobian, new_left, new_cost
                damping = max(damping * (0.1 if gain < 0.5 else 0.5), 1e-9)
                if gain > 0.9999 and cost > 1e-6:
                    break  # a local minimum
            else:
                for joint, position in zip(joints, before, strict=True):
                    joint.position = position
                damping *= 8
                if damping > 1e3:
                    break
        return bool((left <= self._exact(group)).all())

    def _exact(self, group: Group) -> Array:
        """Return the errors, m and rad, that are left where a search has succeeded."""
        return np.array([[min(p[0], 1e-5), min(p[1], 1e-4)] for p in (e.precision for e in self._enabled(group))])

    def _enabled(self, group: Group) -> list[Element]:
        return [each for each in group.elements if each.is_enabled and self._target(each) >= 0]

    def _is_precise(self, group: Group, left: Array) -> bool:
        limits = np.array([each.precision for each in self._enabled(group)])
        return bool((left <= limits).all())

    def _target(self, element: Element) -> int:
        target = self._environment.at(element.tip).target
        return target if target in self._environment.objects else -1

    def _element(self, element: Element) -> tuple[Array, Array, list[IkObject], list[float]]:
        """Return errors, Jacobian and joints of an element, and its linear and angular error without weights."""
        environment = self._environment
        chain = self._chain(element.base, element.tip)
        position, rotation, jacobian = chain.evaluate()
        base = environment.pose(element.base, moved=True)
        goal = environment.pose(self._target(element))
        base_rotation = np.array(rotations.matrix(base[3:]))
        wanted = base_rotation.T @ (np.array(goal[:3]) - np.array(base[:3]))
        wanted_rotation = base_rotation.T @ np.array(rotations.matrix(goal[3:]))
        axes = base_rotation.T  # of the world in the base
        if element.constraint_base != WORLD:
            axes = axes @ np.array(rotations.matrix(environment.pose(element.constraint_base, moved=True)[3:]))
        linear = axes.T @ (wanted - position)
        linear_rows = axes.T @ jacobian[:3]
        kept = [i for i in range(3) if element.constraints & (X << i)]
        errors, rows = [linear[kept] * element.weights[0]], [linear_rows[kept] * element.weights[0]]
        turn, turn_rows = _turn_error(rotation, wanted_rotation, jacobian[3:], element.constraints)
        errors.append(turn * element.weights[1])
        rows.append(turn_rows * element.weights[1])
        left = [float(np.linalg.norm(linear[kept])), float(np.linalg.norm(turn))]
        return np.concatenate(errors), np.vstack(rows), chain.joints, left

    def _chain(self, base: int, tip: int) -> Chain:
        if self._structure != self._environment.structure:
            self._chains.clear()
            self._structure = self._environment.structure
        chain = self._chains.get((base, tip))
        if chain is None or not chain.is_current():
            chain = self._chains[base, tip] = Chain(self._environment, base, tip)
        return chain


def _turn_error(rotation: Array, wanted: Array, jacobian: Array, constraints: int) -> tuple[Array, Array]:
    """Return the error of the orientation in the axes of the tip, and its Jacobian: two numbers for the direction of z,
    a third one for the rotation about it."""
    if not constraints & (ALPHA_BETA | GAMMA):
        return np.zeros(0), np.zeros((0, jacobian.shape[1]))
    difference = rotation.T @ wanted
    if constraints & GAMMA:
        vector = _rotation_vector(difference)
        kept = [0, 1, 2] if constraints & ALPHA_BETA else [2]
    else:  # the shortest rotation of z to that of the target
        z = difference[:, 2]
        axis = np.array([-z[1], z[0], 0.0])
        size = float(np.linalg.norm(axis))
        angle = float(np.arctan2(size, z[2]))
        vector = axis / size * angle if size > _SMALLEST else np.array([angle, 0.0, 0.0])
        kept = [0, 1]
    return vector[kept], (rotation.T @ jacobian)[kept]


def _rotation_vector(matrix: Array) -> Array:
    """Return axis times angle of a rotation matrix."""
    axis = np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]])
    sine, cosine = float(np.linalg.norm(axis)) / 2, (float(np.trace(matrix)) - 1) / 2
    angle = float(np.arctan2(sine, cosine))
    if sine > 1e-7:
        return axis / (2 * sine) * angle
    if cosine > 0:
        return axis / 2
    # Half a turn: the axis is a column of R + 1.
    column = int(np.argmax(np.diag(matrix)))
    found = (matrix + np.eye(3))[:, column]
    return found / np.linalg.norm(found) * angle


def _step(group: Group, error: Array, jacobian: Array, joints: list[IkObject]) -> Array | None:
    """Return the step of the joints by the group's method; None if there is none."""
    weights = np.sqrt(np.array([joint.weight for joint in joints]))
    weighted = jacobian * weights
    if group.method == TRANSPOSE:
        way = weighted @ (weighted.T @ error)
        size = float(way @ way)
        step: Array = weights * (weighted.T @ error) * (float(error @ way) / size if size else 0.0)
        return step
    damping = group.damping if group.method == DAMPED else 1e-6
    square = weighted @ weighted.T + damping * damping * np.eye(len(error))
    try:
        result: Array = np.asarray(weights * (weighted.T @ np.linalg.solve(square, error)))
    except np.linalg.LinAlgError:
        return None
    if not np.isfinite(result).all():
        return None
    return result


def _move(joints: list[IkObject], step: Array, *, limited: bool) -> None:
    """Move joints, all by the same share of their steps, within their limits."""
    share = 1.0
    for joint, way in zip(joints, step, strict=True):
        if limited and abs(way) > joint.max_step:
            share = min(share, joint.max_step / abs(float(way)))
    for joint, way in zip(joints, step, strict=True):
        after = joint.position + share * float(way)
        joint.position = after if joint.cyclic else min(max(after, joint.low), joint.high)


def _free(joints: list[IkObject], direction: Array) -> list[int]:
    """Return the joints that are not at a limit beyond which they would go."""
    kept = []
    for number, joint in enumerate(joints):
        at_low = not joint.cyclic and joint.position <= joint.low + 1e-9 and direction[number] < 0
        at_high = not joint.cyclic and joint.position >= joint.high - 1e-9 and direction[number] > 0
        if not (at_low or at_high):
            kept.append(number)
    return kept or list(range(len(joints)))


def _nearest_turn(joint: IkObject, position: float) -> float:
    """Return the position of a revolute joint without whole turns: within half a turn, or within its limits."""
    if joint.joint_type == PRISMATIC:
        return position
    if joint.cyclic:
        return math.remainder(position, math.tau)
    return position - math.tau * round((position - (joint.low + joint.high) / 2) / math.tau)


def _interval(joint: IkObject) -> tuple[float, float]:
    if joint.cyclic:
        return -np.pi, np.pi
    return max(joint.low, -1e3), min(joint.high, 1e3)


def manipulability(jacobian: Any) -> float:
    """Return Yoshikawa's measure of a Jacobian."""
    return float(np.sqrt(max(0.0, float(np.linalg.det(jacobian @ jacobian.T)))))
