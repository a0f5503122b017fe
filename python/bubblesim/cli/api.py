# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim api: show the functions that child scripts can call, as on their reference pages."""

from __future__ import annotations

import argparse
import difflib
import inspect
import sys
import textwrap
from collections.abc import Mapping
from typing import Any

from bubblesim.cli.terminal import painted
from bubblesim.scripting.api import old_names
from bubblesim.scripting.api.functions import MODULES, ScriptFunction, functions, kinds_of
from bubblesim.scripting.api.ik import ik_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.image import image_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.ompl import ompl_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.reference import call, differing, text
from bubblesim.scripting.api.ros import ros_modules  # noqa: F401  # register their modules
from bubblesim.scripting.api.sim import remote_api_module, sim_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.ui import ui_module  # noqa: F401  # register their modules
from bubblesim.scripting.api.vision import vision_module  # noqa: F401  # register their modules

_WIDTH = 100


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "api",
        help="show the functions for child scripts",
        description="Shows a function for child scripts: its arguments, their types and a description. Part of a name "
        "shows all functions that contain it; no name, or the name of a module, lists one line per function.",
        epilog="examples: bubblesim api getObject; bubblesim api simROS; bubblesim api simROS2.createClient",
    )
    parser.add_argument(
        "function", nargs="?", default="", help="a function, part of its name, or a module: sim, simROS"
    )
    parser.set_defaults(command=_show, parser=parser)


def _show(options: argparse.Namespace) -> int:
    wanted: str = options.function
    known = {f"{module}.{function.name}": function for module in MODULES for function in functions(MODULES[module])}
    if not wanted or wanted in MODULES:
        for name, function in known.items():
            if name.startswith(f"{wanted}." if wanted else ""):
                mark = " (remote clients only)" if function.for_remote_only else ""
                print(f"{call(name, function)}{mark}: {_first_sentence(function)}")
        return 0
    chosen = {name: f for name, f in known.items() if wanted in (name, f.name)}
    if not chosen and (present := _present_name(wanted, known)):
        print(f"{wanted} is an old name of {present}")
        chosen = {present: known[present]}
    chosen = chosen or {name: f for name, f in known.items() if wanted.lower() in name.lower()}
    if not chosen:
        near = difflib.get_close_matches(wanted.rpartition(".")[2], {f.name for f in known.values()}, n=5)
        hint = f"; did you mean {', '.join(near)}?" if near else "; `bubblesim api` lists them all"
        print(f"error: there is no script function '{wanted}'{hint}", file=sys.stderr)
        return 2
    print("\n\n".join(_described(name, function) for name, function in chosen.items()))
    return 0


def _present_name(old: str, known: Mapping[str, ScriptFunction]) -> str | None:
    """Return the present name, with its module, of a function of older versions."""
    module, _, name = old.rpartition(".")
    if module:
        present = f"{module}.{old_names.present_name(module, name)}"
    else:
        present = ".".join(old_names.of_v_rep(old, lambda module, name: f"{module}.{name}" in known) or ())
    return present if present in known else None


def _first_sentence(function: ScriptFunction) -> str:
    return text(function).partition(". ")[0].removesuffix(".")


def _described(name: str, function: ScriptFunction) -> str:
    lines = [painted(call(name, function), "bold", sys.stdout)]
    kinds = kinds_of(MODULES[name.partition(".")[0]], function.name)
    width = max(map(len, kinds), default=0)
    for parameter in function.signature.parameters.values():
        kind = kinds.get(parameter.name)
        optional = "" if parameter.default is inspect.Parameter.empty else ", optional"
        lines.append(f"  {parameter.name:{width}}  {kind.words if kind else 'anything'}{optional}")
    if name.startswith("sim."):
        lines.append(
            f"  for {'remote clients only' if function.for_remote_only else 'child scripts and remote clients'}"
        )
    paragraphs = filter(None, (text(function), differing(function)))
    lines += [textwrap.fill(each, _WIDTH, initial_indent="  ", subsequent_indent="  ") for each in paragraphs]
    return "\n".join(lines)
