# SPDX-License-Identifier: BSD-3-Clause
"""Warnings about plugins that are not supported."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

from bubblesim.gazebo_plugins.parameters import where
from bubblesim.gazebo_plugins.registry import NOT_NEEDED, library, why_unknown
from bubblesim.program.output import write_line


class UnknownPlugins:
    """Warns once per place in a file, for any number of models created from it."""

    def __init__(self) -> None:
        """Nothing is reported yet."""
        self._warned: set[tuple[str, str, int]] = set()

    @property
    def warned(self) -> int:
        """The number of warnings so far."""
        return len(self._warned)

    def report(self, plugin: Any) -> None:
        """Warn about a plugin that is not supported, if it has an effect in Gazebo."""
        name = library(plugin.filename)
        if name not in NOT_NEEDED:
            self.warn(plugin, f"plugin '{plugin.name}' ({plugin.filename}): {why_unknown(name)}")

    def warn(self, plugin: Any, text: str) -> None:
        """Write a warning with the place of a plugin."""
        key = (text, plugin.file, plugin.line)
        if key not in self._warned:
            self._warned.add(key)
            write_line(sys.stderr, f"warning: {where(plugin)}: {text}")


def plugins_below(world: Any, handle: int) -> Iterator[tuple[int, Any]]:
    """Yield the plugins of an outermost model and of its parts, each with its owner."""
    for plugin in world.plugins(handle):
        yield handle, plugin
    inner = [model for model in world.parts(handle, "model") if model != handle]
    for part in [*inner, *world.parts(handle, "sensor")]:
        for plugin in world.plugins(part):
            yield part, plugin
