# SPDX-License-Identifier: BSD-3-Clause
"""Plots the driven path over the scene, in top view."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import numpy.typing as npt

import bubblesim
from bubblesim.geometry.rotations import matrix
from bubblesim.running.recording import Pose, Recording

mpl.use("Agg")  # no display needed

from matplotlib import pyplot as plt
from matplotlib.collections import LineCollection
from matplotlib.patches import Polygon

Points = npt.NDArray[np.float64]

_OBSTACLE: dict[str, Any] = {"facecolor": "#c9ccd1", "edgecolor": "#6b7078", "linewidth": 0.8, "zorder": 1}
_ROBOT_AT_START: dict[str, Any] = {
    "facecolor": "none",
    "edgecolor": "#333333",
    "linewidth": 0.9,
    "linestyle": (0, (3, 2)),
    "zorder": 4,
}
_ROBOT_AT_END: dict[str, Any] = {
    "facecolor": "#e4572e",
    "edgecolor": "#7a2410",
    "linewidth": 0.8,
    "alpha": 0.85,
    "zorder": 4,
}


def draw(scene: str, recording: Recording, file: Path) -> None:
    """Write a PNG: obstacles, the robot at start and end, its path coloured by simulated time."""
    shapes = [shape for shape in bubblesim.Simulation(scene).collisions if shape.kind != "plane"]
    obstacles = [outline(shape) for shape in shapes if shape.is_static]
    robot = [outline(shape) for shape in seen_of_robot([shape for shape in shapes if not shape.is_static])]
    start, end = recording.samples[0].pose, recording.samples[-1].pose

    figure, axes = plt.subplots(figsize=(7.5, 6.5), dpi=130, layout="constrained")
    for points in obstacles:
        axes.add_patch(Polygon(points, **_OBSTACLE))
    for points in robot:
        axes.add_patch(Polygon(points, **_ROBOT_AT_START))
        axes.add_patch(Polygon(moved(points, start, end), **_ROBOT_AT_END))
    _draw_path(figure, axes, recording)
    _mark(axes, "start", start, "#333333")
    _mark(axes, "end", end, "#7a2410")
    _frame(axes, [*obstacles, *robot, np.array([[sample.pose.x, sample.pose.y] for sample in recording.samples])])
    axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
    axes.set_title(f"{scene}: {recording.distance():.1f} m in {recording.sim_duration():.1f} s of simulated time")
    axes.grid(color="#e8e8e8", linewidth=0.6)
    axes.set_axisbelow(True)
    figure.savefig(file, bbox_inches="tight")
    plt.close(figure)


def seen_of_robot(shapes: list[bubblesim.CollisionShape]) -> list[bubblesim.CollisionShape]:
    """Return the shapes without the spheres of links that have other shapes: they only model a wheel's contact."""
    with_body = {shape.object_path for shape in shapes if shape.kind != "sphere"}
    return [shape for shape in shapes if shape.kind != "sphere" or shape.object_path not in with_body]


def outline(shape: bubblesim.CollisionShape) -> Points:
    """Return the shape's outline in top view, n x 2, metres in the scene's frame."""
    circle = np.linspace(0.0, 2.0 * np.pi, 48, endpoint=False)
    if shape.kind == "sphere":
        local = shape.size[0] * np.column_stack([np.cos(circle), np.sin(circle), np.zeros_like(circle)])
        return np.asarray((local + shape.position)[:, :2])
    if shape.kind == "box":
        signs = np.array(np.meshgrid(*[(-0.5, 0.5)] * 3)).reshape(3, -1).T
        local = signs * np.array(shape.size)
    elif shape.kind == "mesh":
        local = np.asarray(shape.vertices, dtype=np.float64)
    elif shape.kind == "ellipsoid":
        local = np.array(shape.size) * _unit_sphere()
    elif shape.kind == "capsule":
        radius, length = shape.size
        ends = [(0.0, 0.0, -length / 2.0), (0.0, 0.0, length / 2.0)]
        local = np.vstack([radius * _unit_sphere() + end for end in ends])
    else:  # cylinder: its two rims
        radius, length = shape.size
        rim = radius * np.column_stack([np.cos(circle), np.sin(circle)])
        local = np.vstack([np.column_stack([rim, np.full(len(rim), end)]) for end in (-length / 2.0, length / 2.0)])
    world = local @ np.array(matrix(shape.orientation)).T + shape.position
    return convex_hull(world[:, :2])


def _unit_sphere() -> Points:
    around, up = np.meshgrid(
        np.linspace(0.0, 2.0 * np.pi, 48, endpoint=False), np.linspace(-np.pi / 2.0, np.pi / 2.0, 25)
    )
    points = np.stack([np.cos(around) * np.cos(up), np.sin(around) * np.cos(up), np.sin(up)], axis=-1)
    return np.asarray(points.reshape(-1, 3))


def convex_hull(points: Points) -> Points:
    """Return the corners of the convex hull of points in the plane, counter-clockwise."""

    def half(ordered: Iterable[tuple[float, ...]]) -> list[tuple[float, ...]]:
        chain: list[tuple[float, ...]] = []
        for point in ordered:
            while len(chain) > 1 and _turn(chain[-2], chain[-1], point) <= 0.0:
                chain.pop()
            chain.append(point)
        return chain[:-1]

    ordered = sorted({tuple(map(float, point)) for point in points})
    return np.array(half(ordered) + half(reversed(ordered)))


def _turn(a: tuple[float, ...], b: tuple[float, ...], c: tuple[float, ...]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def moved(points: Points, start: Pose, end: Pose) -> Points:
    """Return points fixed to a body after it has moved from one pose to another."""
    angle = end.heading - start.heading
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return np.asarray((points - [start.x, start.y]) @ turn.T + [end.x, end.y])


def _draw_path(figure: Any, axes: Any, recording: Recording) -> None:
    points = np.array([[sample.pose.x, sample.pose.y] for sample in recording.samples])
    times = np.array([sample.sim_time for sample in recording.samples])
    pieces = list(np.stack([points[:-1], points[1:]], axis=1))
    path = LineCollection(pieces, cmap="viridis", linewidth=2.2, zorder=3)
    path.set_array(times[:-1])
    axes.add_collection(path)
    figure.colorbar(path, ax=axes, label="simulated time [s]", shrink=0.85)


def _mark(axes: Any, text: str, pose: Pose, color: str) -> None:
    axes.plot(pose.x, pose.y, "o", color=color, markersize=5, zorder=5)
    box = {"boxstyle": "round,pad=0.2", "facecolor": "white", "edgecolor": color, "linewidth": 0.6, "alpha": 0.85}
    axes.annotate(
        text, (pose.x, pose.y), (0, -26), textcoords="offset points", ha="center", color=color, bbox=box, zorder=6
    )


def _frame(axes: Any, drawn: list[Points]) -> None:
    corners = np.vstack(drawn)
    margin = 0.05 * max(np.ptp(corners, axis=0).max(), 1.0)
    axes.set_xlim(corners[:, 0].min() - margin, corners[:, 0].max() + margin)
    axes.set_ylim(corners[:, 1].min() - margin, corners[:, 1].max() + margin)
