# SPDX-License-Identifier: BSD-3-Clause
"""The objects of the scene, with all that is needed to draw them."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

from bubblesim.remote.window.window import Window


def share(window: Window) -> dict[str, Any]:
    """Return where the frames are, and what stays the same while the scene runs."""
    simulation = window.simulation
    return {
        "frames": window.memory.path,
        "process": os.getpid(),
        "scene": simulation.scene_name,
        "file": str(simulation.scene_file),
        "time_step": simulation.time_step,
        "next_event": window.next_event,
        "ros": window.host.bridge is not None,
    }


def events(window: Window, since: int = 0) -> dict[str, Any]:
    """Return the events from a number on."""
    return window.events(since)


def models(window: Window, known: list[int] | None = None) -> dict[str, Any]:
    """Return the objects of all models, except of those whose handles are known, and the handles of all models.

    ``frames`` are all dummies and other objects of no model. ``links`` are the handles of the links whose poses are in
    the frames of the run, in their order; ``axes`` are pairs of joint and axis of the joint positions there.
    ``colours`` are pairs of a link and the colour that was set for it.
    """
    simulation = window.simulation
    handles = [int(model) for model in simulation.world.models]
    skipped = set(known or [])
    frame = window.runner.frame
    return {
        "models": handles,
        "objects": [
            each for handle in handles if handle not in skipped for each in window.view.model(simulation, handle)
        ],
        "frames": window.view.frames(simulation),
        "links": frame.links,
        "axes": [list(axis) for axis in frame.axes],
        "revision": frame.revision & 0xFFFFFFFF,
        "colours": [[link, colour] for link, colour in window.edits.colours.links.items()],
        "environment": window.view.environment(simulation),
    }


def mesh(window: Window, number: int) -> dict[str, Any]:
    """Return the arrays of a mesh as bytes: float32 coordinates, uint32 indices, uint16 materials."""
    value: dict[str, Any] = window.view.mesh(number)
    return value


def texture(window: Window, number: int) -> dict[str, Any]:
    """Return the size of an image, and its RGB bytes from the top."""
    value: dict[str, Any] = window.view.texture(number)
    return value


FUNCTIONS: tuple[Callable[..., Any], ...] = (share, events, models, mesh, texture)
