# SPDX-License-Identifier: BSD-3-Clause
"""Start, pause, stop and step, without waiting for them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim.remote.window.window import Window


def start(window: Window) -> None:
    """Start a stopped simulation, or continue after a pause."""
    window.runner.start(wait=False)


def pause(window: Window) -> None:
    """Pause between two steps."""
    window.runner.pause(wait=False)


def stop(window: Window) -> None:
    """Run one more step, and go back to the start of the scene."""
    window.runner.stop(wait=False)


def step(window: Window, steps: int = 1) -> None:
    """Run steps of a paused simulation; pause one that runs, start one that is stopped."""
    name = window.runner.state.name
    if name == "STOPPED":
        window.runner.start(wait=False)
    if name in ("STOPPED", "RUNNING"):
        window.runner.pause(wait=False)
    window.runner.step(steps, wait=False)


def speed(window: Window, factor: float | None = None) -> float:
    """Set the speed in simulated seconds per second, 0 for as fast as possible, if it is given; return it.

    All pages are sent a new one as an event, ``speed``.
    """
    if factor is not None:
        window.runner.set_speed(float("inf") if factor == 0 else float(factor), wait=False)
        window.emit("speed", factor)
        return factor
    now: float = window.runner.speed
    return 0.0 if now == float("inf") else now


FUNCTIONS: tuple[Callable[..., Any], ...] = (start, pause, stop, step, speed)
