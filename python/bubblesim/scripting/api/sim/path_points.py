# SPDX-License-Identifier: BSD-3-Clause
"""Paths as lists of configurations: lengths, interpolation, nearest points."""

from __future__ import annotations

import bisect
import itertools
import math
from collections.abc import Callable, Sequence

Config = list[float]
LINEAR, CYCLIC, QUATERNION = 0, 1, 2  # types of the numbers of a configuration
_LEAST_STRENGTH = 0.05


def rows(path: Sequence[float], size: int) -> list[Config]:
    """Return the configurations of a path that is given as one list."""
    if size < 1 or len(path) % size or not path:
        raise ValueError(f"a path of configurations of {size} numbers has a multiple of that, found {len(path)}")
    return [list(path[i : i + size]) for i in range(0, len(path), size)]


def distance(a: Sequence[float], b: Sequence[float]) -> float:
    """Return the Euclidean distance of two configurations."""
    return math.dist(a, b)


def lengths(configs: list[Config], between: Callable[[Config, Config], float] = distance) -> list[float]:
    """Return the length of the path up to each configuration."""
    found = [0.0]
    for a, b in itertools.pairwise(configs):
        found.append(found[-1] + between(a, b))
    return found


def mixed(a: Config, b: Config, share: float, types: Sequence[int]) -> Config:
    """Return a configuration between two: angles of cyclic axes by the shorter way, quaternions of length 1."""
    result: Config = []
    number = 0
    while number < len(a):
        kind = types[number] if number < len(types) else LINEAR
        if kind == QUATERNION and number + 4 <= len(a):
            result += _mixed_quaternion(a[number : number + 4], b[number : number + 4], share)
            number += 4
            continue
        difference = b[number] - a[number]
        result.append(a[number] + share * (math.remainder(difference, math.tau) if kind == CYCLIC else difference))
        number += 1
    return result


def linear(configs: list[Config], along: list[float], at: float, types: Sequence[int]) -> Config:
    """Return the configuration at a length along the path, on the lines between configurations."""
    at = min(max(at, 0.0), along[-1])
    index = min(max(bisect.bisect_right(along, at) - 1, 0), max(len(along) - 2, 0))
    if len(along) == 1 or along[index + 1] <= along[index]:
        return list(configs[min(index, len(configs) - 1)])
    share = (at - along[index]) / (along[index + 1] - along[index])
    return mixed(configs[index], configs[index + 1], share, types)


def rounded(
    configs: list[Config], along: list[float], at: float, types: Sequence[int], strength: float, *, closed: bool
) -> Config:
    """Return the configuration at a length along the path, whose corners are quadratic Bezier curves.

    :param strength: share of the lines beside a corner that the curve takes, up to 1.
    """
    total = along[-1]
    if total <= 0:
        return list(configs[0])
    strength = min(max(strength, _LEAST_STRENGTH), 1.0)
    at = min(max(at, 0.0), total)
    corners = range(len(configs) - 1) if closed else range(1, len(configs) - 1)
    for index in corners:
        before = along[index] - along[index - 1] if index else total - along[-2]
        after = along[index + 1] - along[index]
        offset = at - along[index]
        if index == 0 and offset > total / 2:  # the end of a closed path is before its first corner
            offset -= total
        reach_before, reach_after = before * strength / 2, after * strength / 2
        if not -reach_before <= offset <= reach_after or reach_before + reach_after <= 0:
            continue
        begin = along[index] - reach_before
        start = linear(configs, along, begin % total if index == 0 else begin, types)
        end = linear(configs, along, along[index] + reach_after, types)
        share = (offset + reach_before) / (reach_before + reach_after)
        first, second = mixed(start, configs[index], share, types), mixed(configs[index], end, share, types)
        return mixed(first, second, share, types)
    return linear(configs, along, at, types)


def nearest(configs: list[Config], along: list[float], point: Sequence[float]) -> float:
    """Return the length along the path to the place nearest to a point, by the first three numbers."""
    best, found = math.inf, 0.0
    for index, config in enumerate(configs):
        a = config[:3]
        b = configs[index + 1][:3] if index + 1 < len(configs) else a
        way = [y - x for x, y in zip(a, b, strict=True)]
        square = sum(w * w for w in way)
        share = sum((p - x) * w for p, x, w in zip(point, a, way, strict=True)) / square if square else 0.0
        share = min(max(share, 0.0), 1.0)
        far = math.dist(point[:3], [x + share * w for x, w in zip(a, way, strict=True)])
        if far < best:
            after = along[index + 1] if index + 1 < len(along) else along[index]
            best, found = far, along[index] + share * (after - along[index])
    return found


def _mixed_quaternion(a: Config, b: Config, share: float) -> Config:
    """Return a quaternion between two on the shorter arc (slerp)."""
    cosine = sum(x * y for x, y in zip(a, b, strict=True))
    end = b if cosine >= 0 else [-y for y in b]
    angle = math.acos(min(1.0, abs(cosine)))
    near, far = 1 - share, share
    if angle > 1e-9:
        near, far = (math.sin(part * angle) / math.sin(angle) for part in (1 - share, share))
    result = [near * x + far * y for x, y in zip(a, end, strict=True)]
    size = math.hypot(*result) or 1.0
    return [x / size for x in result]
