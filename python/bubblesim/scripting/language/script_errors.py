# SPDX-License-Identifier: BSD-3-Clause
"""What to do about errors of Python whose message does not state it."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Mapping
from pathlib import Path
from types import FunctionType
from typing import Any


def called_wrongly(error: BaseException, functions: Mapping[str, Any]) -> FunctionType | None:
    """Return the function that got other arguments than it takes, by the message of Python."""
    name = re.match(r"(\w+)\(\) (?:takes|missing|got) ", str(error)) if isinstance(error, TypeError) else None
    found = functions.get(name[1]) if name else None
    return found if isinstance(found, FunctionType) else None


def without_self(function: FunctionType | None) -> str:
    """Return what to do about a function of a script that is written like a method; empty for others."""
    parameters = list(inspect.signature(function).parameters) if function else []
    if not function or parameters[:1] != ["self"]:
        return ""
    return f"; `self` is a global of the script: write def {function.__name__}({', '.join(parameters[1:])}):"


def missing_module(error: BaseException, folder: Path, functions: Mapping[str, Any]) -> str:
    """Return what to do about a module that is not found; empty for other errors.

    :param folder: that of the script.
    :param functions: what the script's names mean, among them `sim` and `simROS`.
    """
    if not isinstance(error, ModuleNotFoundError) or not error.name:
        return ""
    name = error.name.partition(".")[0]
    if name in sys.modules:
        return ""  # the package is there, but not all of it
    return _how_to_get(name, folder, functions)


def _how_to_get(name: str, folder: Path, functions: Mapping[str, Any]) -> str:
    if name in functions:
        return f"; {name} is there without an import: remove the line, or write {name} = require('{name}')"
    if (folder / f"{name}.py").is_file():
        return (
            f"; modules are not searched in {folder.resolve()}: begin the script with the line `include {name}`, "
            "or add the folder to PYTHONPATH"
        )
    return (
        f"; scripts run with Python {sys.version_info.major}.{sys.version_info.minor} of {sys.prefix}: install {name} "
        "there, or start the simulator in a virtual environment that has it"
    )
