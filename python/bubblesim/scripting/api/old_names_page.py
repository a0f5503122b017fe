# SPDX-License-Identifier: BSD-3-Clause
"""Writes the page of old names: ``python -m bubblesim.scripting.api.old_names_page``."""

from __future__ import annotations

import sys

from bubblesim.scripting.api.functions import MODULES
from bubblesim.scripting.api.ik import ik_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.image import image_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.old_names import OF_PLUGINS, OF_V_REP, RENAMED
from bubblesim.scripting.api.ompl import ompl_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.ros import ros_modules  # noqa: F401  # register their modules
from bubblesim.scripting.api.sim import remote_api_module, sim_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.ui import ui_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.vision import vision_module  # noqa: F401  # register their modules

_INTRODUCTION = """\
# Old names

<!-- Generated from the table of names by `python -m bubblesim.scripting.api.old_names_page`. -->

Functions and constants of older versions of CoppeliaSim, and of V-REP 3, have these names here. Scripts may use them; a
script that does is named once, in the terminal and in the console of the window. Remote clients may use them, too.

## Functions of V-REP 3

The global functions and constants of V-REP 3 are those of the modules, for scripts in Lua: `simGetObjectHandle` is
`sim.getObjectHandle`, `sim_handle_self` is `sim.handle_self`, `simRMLPos` is `sim.rmlPos`.

| Name in V-REP | Name here |
|---|---|
"""


def page() -> str:
    """Return the page as Markdown."""
    rows = [f"| `{beginning}...` | `{module}...` |" for beginning, module in OF_PLUGINS.items()]
    rows += [f"| `sim{old}` | `sim.{new}` |" for old, new in sorted(OF_V_REP.items())]
    parts = [_INTRODUCTION + "\n".join(rows) + "\n"]
    for module, names in RENAMED.items():
        lines = [f"| `{old}` | `{new}` |" for old, new in sorted(names.items()) if hasattr(MODULES[module], new)]
        parts.append(f"\n## {module}\n\n| Old name | Name here |\n|---|---|\n" + "\n".join(lines) + "\n")
    return "".join(parts)


if __name__ == "__main__":
    sys.stdout.write(page())
