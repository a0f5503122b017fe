# SPDX-License-Identifier: BSD-3-Clause
"""Types of controllers that packages of the user export in their package.xml.

``<export><bubblesim controller="PACKAGE/TYPE" class="MODULE:CLASS"/></export>``. A type is looked up in the package
with which its name begins, on ROS_PACKAGE_PATH: a parameter alone does not choose the code that runs.
"""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from xml.etree import ElementTree

from bubblesim.gazebo_plugins.control.controller import Controller
from bubblesim.gazebo_plugins.control.ros_parameters import ControllerError


def own_controller(kind: str) -> type[Controller] | None:
    """Return the class of a type; None if no package exports it.

    :raises ControllerError: if its class cannot be imported.
    """
    import rospkg  # of ROS, without which models are checked, too

    try:
        folder = Path(rospkg.RosPack().get_path(kind.partition("/")[0]))
    except rospkg.ResourceNotFound:
        return None
    place = _exported(folder / "package.xml", kind)
    if place is None:
        return None
    module, _, name = place.partition(":")
    source = str(folder / "src")  # where catkin packages have their modules
    if source not in sys.path:
        sys.path.append(source)
    try:
        found = getattr(importlib.import_module(module), name)
    except Exception as error:  # also one in the module
        raise ControllerError(f"{folder}/package.xml: {place} cannot be imported: {error}") from None
    if not (isinstance(found, type) and issubclass(found, Controller)):
        raise ControllerError(f"{folder}/package.xml: {place} is no subclass of {Controller.__module__}.Controller")
    return found


def _exported(manifest: Path, kind: str) -> str | None:
    try:
        exports = ElementTree.parse(manifest).iterfind("export/bubblesim")
        return next((each.get("class", "") for each in exports if each.get("controller") == kind), None)
    except (OSError, ElementTree.ParseError):
        return None
