# SPDX-License-Identifier: BSD-3-Clause
"""`simIK` functions that search for configurations and paths."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from bubblesim.geometry import poses
from bubblesim.scripting.api.ik.context import IkContext
from bubblesim.scripting.api.ik.environment import IkObject
from bubblesim.scripting.api.kinds import Integers

_SECONDS = 0.3
_MOST_POINTS = 100_000


class SearchFunctions(IkContext):
    """Searches begin where the joints are, and go on from random configurations within their limits. The joints of the
    environment stay where they are."""

    def findConfig(
        self,
        environment: int,
        group: int,
        joints: Integers,
        threshold: float = 0.1,
        seconds: float = 0.5,
        metric: Any = None,
        callback: Any = None,
        data: Any = None,
    ) -> list[float] | None:
        """Return a configuration of joints that fulfils a group; None (nil) if none is found in time. ``callback``
        gets a configuration and ``data``, and returns whether it is valid."""
        found = self._search(environment, group, joints, seconds, self._validity(callback, data), 1)
        return found[0] if found else None

    def findConfigs(
        self, environment: int, group: int, joints: Integers, options: Any = None, others: Any = None
    ) -> list[list[float]]:
        """Return configurations of joints that fulfil a group, the nearest first. Options: ``maxTime`` (s),
        ``findMultiple``, ``findAlt``, ``cMetric`` (weights of the distances), ``cb`` and ``auxData``."""
        wanted = options if isinstance(options, Mapping) else {}
        most = 16 if wanted.get("findMultiple") or wanted.get("findAlt") else 1
        valid = self._validity(wanted.get("cb"), wanted.get("auxData"))
        seconds = float(wanted.get("maxTime", _SECONDS))
        found = self._search(environment, group, joints, seconds, valid, most)
        now = [self._joint(environment, joint).position for joint in joints]
        weights = list(wanted.get("cMetric") or [1.0] * len(now))
        return sorted(
            found, key=lambda each: sum((w * (a - b)) ** 2 for w, a, b in zip(weights, each, now, strict=False))
        )

    def getAlternateConfigs(
        self, environment: int, joints: Integers, low: Any = None, ranges: Any = None
    ) -> list[list[float]]:
        """Return the configuration of joints, and those with a full turn more or less within their limits."""
        found = [[self._joint(environment, joint).position for joint in joints]]
        for number, joint in enumerate(joints):
            each = self._joint(environment, joint)
            if each.cyclic or each.joint_type != 10:
                continue
            for config in list(found):
                for turns in (-1, 1):
                    position = config[number] + turns * 2 * np.pi
                    if each.low <= position <= each.high:
                        found.append([*config[:number], float(position), *config[number + 1 :]])
        return found

    def generatePath(
        self,
        environment: int,
        group: int,
        joints: Integers,
        tip: int,
        points: int,
        callback: Any = None,
        data: Any = None,
    ) -> list[float]:
        """Return configurations of joints, one after the other, with which a tip goes straight to its target in a
        number of points; an empty list if it cannot."""
        found = self._environment(environment)
        if not 2 <= points <= _MOST_POINTS:
            raise ValueError(f"a path has 2 to {_MOST_POINTS} points, found {points}")
        target = found.at(tip).target
        if target < 0:
            raise ValueError("the tip has no target")
        chain = [self._joint(environment, joint) for joint in joints]
        before = {each.handle: each.position for each in found.objects.values() if each.is_joint}
        start, end = found.pose(tip), found.pose(target)
        valid = self._validity(callback, data)
        path: list[float] = []
        try:
            for number in range(points):
                found.set_pose(target, poses.interpolate(start, end, number / (points - 1)))
                if not self._solver(environment).converge(found.group(group)):
                    return []
                config = [joint.position for joint in chain]
                if not valid(config):
                    return []
                path += config
        finally:
            found.set_pose(target, end)
            for handle, position in before.items():
                found.objects[handle].position = position
        return path

    def _search(
        self,
        environment: int,
        group: int,
        joints: Integers,
        seconds: float,
        valid: Callable[[list[float]], bool],
        most: int,
    ) -> list[list[float]]:
        chosen: list[IkObject] = [self._joint(environment, joint) for joint in joints]
        random = np.random.default_rng(int(self._simulation.seed))
        limit = min(max(seconds, 0.0), 60.0)
        solver, target = self._solver(environment), self._group(environment, group)
        return solver.search(target, chosen, limit, valid, random, most=most)

    def _validity(self, callback: Any, data: Any) -> Callable[[list[float]], bool]:
        """Return a function that asks the script whether a configuration is valid."""
        if callback is None:
            return lambda config: True
        if self._caller.is_remote:
            raise TypeError("a remote client cannot check configurations: check those that are returned")
        call = callback if callable(callback) else self._caller.answering_callback(callback, lambda result: None)
        return lambda config: bool(call(config, data))
