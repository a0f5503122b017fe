# SPDX-License-Identifier: BSD-3-Clause
"""The plots of docs/physics.md: motion beside its theory."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl

mpl.use("Agg")
import numpy as np
from matplotlib import pyplot as plt

from . import friction, rotation, vehicles
from .mechanics import runge_kutta, spin_in_body

COLOURS = {"theory": "#222222", "bubblesim": "#1f77b4", "ODE": "#9467bd", "MuJoCo": "#d62728", "PyBullet": "#2ca02c"}
MARKS = {"bubblesim": "o", "ODE": "x", "MuJoCo": "s", "PyBullet": "^"}


def inclines(axes: Any, engines: Sequence[Any]) -> None:
    """Draw the least slope over its direction."""
    directions = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0]
    axes.axhline(math.degrees(math.atan(0.5)), color=COLOURS["theory"], label="theory")
    for engine in engines:
        slopes = [friction.incline(engine, 0.5, heading, 0.0) for heading in directions]
        axes.plot(directions, slopes, MARKS[engine.name], color=COLOURS[engine.name], label=engine.name)
    axes.set(title="Least slope at which a box slides, mu 0.5", xlabel="direction of the slope (deg)", ylabel="deg")
    axes.set_ylim(22, 40)


def turns(axes: Any, engines: Sequence[Any]) -> None:
    """Draw the yaw rate of skid steering over the ratio of base and track."""
    ratios = [0.5, 0.75, 1.0, 1.25, 1.5]
    fine = np.linspace(0.4, 1.6, 50)
    axes.plot(fine, [vehicles.spot_rate(0.4 * r, 0.4) for r in fine], color=COLOURS["theory"], label="theory")
    for engine in engines:
        rates = [vehicles.skid_steer(engine, 0.4 * ratio, 0.4) for ratio in ratios]
        axes.plot(ratios, rates, MARKS[engine.name], color=COLOURS[engine.name], label=engine.name)
    axes.set(title="Skid steering in place, 5 ms", xlabel="wheel base / track", ylabel="rad/s")
    axes.set_ylim(bottom=0)


def swings(axes: Any, engines: Sequence[Any]) -> None:
    """Draw the angle of a pendulum that starts at 170 degrees."""
    bob = rotation.BOB
    pull = bob.mass * 9.81 * rotation.LENGTH / (bob.mass * rotation.LENGTH**2 + bob.inertia[1])
    start = np.array([math.radians(170), 0.0])
    states = runge_kutta(lambda s: np.array([s[1], -pull * math.sin(s[0])]), start, 0.001, 25000)
    axes.plot(np.arange(25001) * 0.001, np.degrees([s[0] for s in states]), color=COLOURS["theory"], label="theory")
    for engine in engines:
        world = rotation.swinging(engine, 170.0, 0.005)
        times, angles = [], []
        while world.time < 25:
            world.run(0.05)
            arm = world.position("bob") - np.array([0, 0, 3.0])
            times.append(world.time)
            angles.append(math.degrees(math.atan2(-arm[0], -arm[2])))
        axes.plot(times, angles, "--", color=COLOURS[engine.name], label=engine.name)
    axes.set(title="Pendulum from 170 degrees, 5 ms", xlabel="s", ylabel="deg")


def flips(axes: Any, engines: Sequence[Any]) -> None:
    """Draw the spin about the middle axis of inertia."""
    i1, i2, i3 = rotation.TENNIS_RACKET.inertia

    def rates(w: np.ndarray) -> np.ndarray:
        return np.array([(i2 - i3) / i1 * w[1] * w[2], (i3 - i1) / i2 * w[2] * w[0], (i1 - i2) / i3 * w[0] * w[1]])

    states = runge_kutta(rates, np.array(rotation.START), 0.001, 20000)
    axes.plot(np.arange(20001) * 0.001, [w[1] for w in states], color=COLOURS["theory"], label="theory")
    for engine in engines:
        world = rotation.in_space(engine, rotation.TENNIS_RACKET, rotation.START, 0.001)
        times, middle = [], []
        while world.time < 20:
            world.run(0.02)
            times.append(world.time)
            middle.append(float(spin_in_body(world, rotation.TENNIS_RACKET)[1]))
        axes.plot(times, middle, "--", color=COLOURS[engine.name], label=engine.name)
    axes.set(title="Spin about the middle axis, 1 ms", xlabel="s", ylabel="rad/s")


def draw(folder: str, engines: Sequence[Any]) -> None:
    """Write physics.png."""
    figure, all_axes = plt.subplots(2, 2, figsize=(11, 7.5))
    for axes, plot in zip(all_axes.flat, (inclines, turns, swings, flips), strict=True):
        plot(axes, engines)
        axes.grid(alpha=0.3)
    all_axes[0, 0].legend(loc="upper right")
    figure.tight_layout()
    Path(folder).mkdir(parents=True, exist_ok=True)
    figure.savefig(Path(folder) / "physics.png", dpi=90, metadata={"Software": None})
    plt.close(figure)
