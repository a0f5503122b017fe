# SPDX-License-Identifier: BSD-3-Clause
"""The colours that scripts and programs have given to links."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any


@dataclass
class SetColours:
    """They stay until the scene is closed."""

    links: dict[int, list[float]] = field(default_factory=dict)
    """Red, green, blue from 0 to 1, by handle of the link."""
    changed: Callable[[list[int]], None] = lambda _links: None
    """Called with the links that have another colour now."""

    def set(self, simulation: Any, handle: int, colour: Sequence[float]) -> None:
        """Give all visuals of a link or model one colour.

        :raises RuntimeError: for objects that have no colour, and for numbers that are not from 0 to 1.
        """
        simulation.set_color(handle, colour)
        links = links_of(simulation.world, handle)
        for link in links:
            self.links[link] = [float(part) for part in colour]
        self.changed(links)

    def of(self, world: Any, model: int) -> list[list[float] | None]:
        """Return the colours of a model's links, None where none was set, for ``give``."""
        return [self.links.get(link) for link in links_of(world, model)]

    def give(self, simulation: Any, model: int, colours: Sequence[Sequence[float] | None]) -> None:
        """Give the links of a model the colours of the model of which it is a copy."""
        for link, colour in zip(links_of(simulation.world, model), colours, strict=True):
            if colour is not None:
                self.set(simulation, link, colour)


def links_of(world: Any, handle: int) -> list[int]:
    """Return a link, or all links of a model and of the models in it."""
    kind = world.kind(handle)
    if kind == "link":
        return [handle]
    return [int(link) for link in world.parts(handle, "link")] if kind == "model" else []
