# SPDX-License-Identifier: BSD-3-Clause
"""Writes the reference page of a script module: ``python -m bubblesim.scripting.api.reference sim``."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Mapping

from bubblesim.scripting.api.functions import MODULES, ScriptFunction, functions
from bubblesim.scripting.api.ik import ik_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.image import image_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.ompl import ompl_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.ros import ros_modules  # noqa: F401  # register their modules
from bubblesim.scripting.api.sim import remote_api_module, sim_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.ui import ui_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.vision import vision_module  # noqa: F401  # register their modules

_INTRODUCTION = """\
# {name}

<!-- Generated from the functions themselves by `python -m bubblesim.scripting.api.reference {name}`. -->

Functions for child scripts in `{name}`. A call with invalid arguments raises a TypeError that names the function, the
argument, the expected and the found value. Units are SI units and radians.
"""


def page(name: str) -> str:
    """Return the page as Markdown, its functions in groups."""
    module = MODULES[name]
    found = functions(module)
    parts = [_INTRODUCTION.format(name=name)]
    for group in dict.fromkeys(base for base in module.__mro__ if any(f.group is base for f in found)):
        parts.append(f"## {_title(group, module)}\n\n{inspect.getdoc(group)}\n")
        parts.append("\n".join(_entry(name, function) for function in found if function.group is group) + "\n")
    return "\n".join(parts)


def _title(group: type, module: type) -> str:
    if group is module:
        return "Functions of this module only"
    return group.__name__.removesuffix("Functions").removeprefix("Ros")


def _entry(module: str, function: ScriptFunction) -> str:
    mark = " *(remote clients only)*" if function.for_remote_only else ""
    entry = f"- `{call(f'{module}.{function.name}', function)}`{mark}: {text(function)} {differing(function)}"
    return entry.rstrip()


def call(name: str, function: ScriptFunction) -> str:
    """Return the signature of a function with its defaults."""
    arguments = ", ".join(
        f"*{name}"
        if parameter.kind is inspect.Parameter.VAR_POSITIONAL
        else name
        if parameter.default is inspect.Parameter.empty
        else f"{name}={_shown(parameter.default)}"
        for name, parameter in function.signature.parameters.items()
    )
    return f"{name}({arguments})"


def text(function: ScriptFunction) -> str:
    """Return the documentation of a function, in one line."""
    return " ".join(function.doc.split()).replace("``", "`")


def differing(function: ScriptFunction) -> str:
    """Return how a function differs from CoppeliaSim's, in one sentence; an empty string if it does not."""
    return f"In CoppeliaSim, {function.differs}." if function.differs else ""


def _shown(default: object) -> str:
    return "{}" if isinstance(default, Mapping) else repr(default)


def main() -> int:
    """Print the page of the given module."""
    if len(sys.argv) != 2 or sys.argv[1] not in MODULES:
        print(f"usage: python -m bubblesim.scripting.api.reference {'|'.join(MODULES)}", file=sys.stderr)
        return 2
    print(page(sys.argv[1]), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
