# SPDX-License-Identifier: BSD-3-Clause
"""The data that all callers of one simulation share."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Protocol

from bubblesim.scene_state.drawings import Drawings
from bubblesim.scene_state.dummies import Dummies
from bubblesim.scene_state.graphs import Graphs
from bubblesim.scene_state.log import Log
from bubblesim.scene_state.object_collections import Collections
from bubblesim.scene_state.panels import Panels
from bubblesim.scene_state.scene_edits import SceneEdits
from bubblesim.scene_state.stored_values import StoredValues
from bubblesim.scene_state.tubes import Tubes
from bubblesim.scene_state.wireless import Wireless


class Scripts(Protocol):
    """The child scripts, for calls between callers."""

    def has_script(self, handle: int) -> bool:
        """Return whether a script is attached to an object."""

    def script_functions(self, handle: int) -> list[str]:
        """Return the names of the global functions of an object's script."""

    def call_script(self, handle: int, function: str, arguments: tuple[Any, ...]) -> Any:
        """Call a global function of an object's script; raise RuntimeError if that fails."""

    def execute(self, handle: int, text: str) -> Any:
        """Run code with the globals of an object's script, and return its value; raise RuntimeError if that fails."""

    def is_confined(self, handle: int) -> bool:
        """Return whether an object's script has no access to files and programs."""

    def broadcast(self, message: Any, origin: int) -> None:
        """Call sysCall_msg of all scripts with a message and the object of its sender, -1 for a program."""

    def remove_model(self, model: int) -> None:
        """Remove a model and its scripts."""

    def descriptions(self) -> list[dict[str, Any]]:
        """Return handle, object, file, language and state of all scripts."""

    def text_of(self, handle: int) -> str:
        """Return the text of the file of an object's script."""

    def restart_script(self, handle: int) -> bool:
        """Load an object's script again from its file; return whether it runs."""

    def add_text(self, handle: int, text: str, suffix: str) -> None:
        """Attach a script, 'py' or 'lua', to an object; raise ValueError if it has one."""

    def problems(self) -> dict[str, Any]:
        """Return the warnings of the scene's files and the problems of scripts, with their revision."""


@dataclass
class SharedData:
    """Data shared by all callers of one simulation."""

    has_ros: bool
    scripts: Scripts | None = None
    """None outside of the node."""
    dummies: Dummies = field(default_factory=Dummies)
    drawings: Drawings = field(default_factory=Drawings)
    graphs: Graphs = field(default_factory=Graphs)
    log: Log = field(default_factory=Log)
    collections: Collections = field(default_factory=Collections)
    edits: SceneEdits = field(default_factory=SceneEdits)
    panels: Panels = field(default_factory=Panels)
    tubes: Tubes = field(default_factory=Tubes)
    wireless: Wireless = field(default_factory=Wireless)
    selected: list[int] = field(default_factory=list)
    """Handles of the objects that scripts have selected."""
    vision_results: dict[int, tuple[bool, list[Any]]] = field(default_factory=dict)
    """By camera: whether its script's sysCall_vision has reported a trigger, and its packets of packed floats."""
    floating_views: int = 0
    """Number of views that scripts have opened."""
    script_parameters: StoredValues[tuple[int, str]] = field(default_factory=lambda: StoredValues("script parameters"))
    """Strings that were set, by object and name; stay after a stop."""
    custom_data: StoredValues[tuple[int, str]] = field(default_factory=lambda: StoredValues("custom data"))
    """By object, -12 for the scene, and name; stays after a stop."""
    settings: StoredValues[tuple[type, int | str]] = field(default_factory=lambda: StoredValues("parameters"))
    """Parameters that only store their value, by kind and number or name; stay after a stop."""
    signals: StoredValues[tuple[type, str]] = field(default_factory=lambda: StoredValues("signals"))
    """By kind and name."""
    cleared_scans: dict[str, float] = field(default_factory=dict)
    """Time of the last measurement, s, when a lidar's signal was cleared, by the signal's name."""

    def clear(self, world: Any) -> None:
        """Delete what ends with a run of a world."""
        self.signals.clear()
        self.wireless.clear()
        self.dummies.end_run(world)
        self.drawings.end_run()
        self.collections.end_run()
        self.edits.end_run(world)
        self.cleared_scans.clear()
        self.vision_results.clear()
