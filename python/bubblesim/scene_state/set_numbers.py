# SPDX-License-Identifier: BSD-3-Clause
"""The masses (kg) and friction coefficients that programs have given to links."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from bubblesim._core import WrongObject
from bubblesim.scene_state.set_colours import links_of

NAMES = ("mass", "friction")


@dataclass
class SetNumbers:
    """Those of the stopped scene stay; those of a run end with it, by the reset of the world."""

    links: dict[int, dict[str, float]] = field(default_factory=dict)
    """By handle of the link, then by name."""

    def set(self, world: Any, handle: int, name: str, value: float, *, stays: bool) -> None:
        """Set a number of a link, or of all links of a model; the mass of a model is that of all its links.

        :raises ValueError: for objects that do not have it, and for numbers that cannot be.
        """
        getattr(world, f"set_{name}")(handle, value)
        for link in links_of(world, handle) if stays else ():
            try:
                self.links.setdefault(link, {})[name] = float(getattr(world, name)(link))
            except WrongObject:  # a link without collisions has no friction
                continue

    def restore(self, world: Any) -> None:
        """Set the numbers again, after the world was reset."""
        for link, numbers in self.links.items():
            for name, value in numbers.items():
                getattr(world, f"set_{name}")(link, value)

    def of(self, world: Any, model: int) -> list[dict[str, float]]:
        """Return the numbers of a model's links, for ``give``."""
        return [dict(self.links.get(link, {})) for link in links_of(world, model)]

    def give(self, world: Any, model: int, numbers: list[dict[str, float]]) -> None:
        """Give the links of a model the numbers of the model of which it is a copy."""
        for link, own in zip(links_of(world, model), numbers, strict=True):
            for name, value in own.items():
                self.set(world, link, name, value, stays=True)
