# SPDX-License-Identifier: BSD-3-Clause
"""Plugins of the user, which a <plugin> names: classes in Python, and devices in libraries in C++.

A file of a model alone does not choose the code that runs: only what a package on ROS_PACKAGE_PATH exports in its
package.xml is loaded, or what an installed Python distribution offers in the entry points ``bubblesim.plugins``.
"""

from __future__ import annotations

import importlib
import os
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from bubblesim.gazebo_plugins.parameters import ParameterError
from bubblesim.gazebo_plugins.plugin import FailedInSubstepError, Plugin, PluginContext
from bubblesim.program.output import write_line

_BASE = "bubblesim::PluginDevice"
_CLASS = re.compile(r"\w+(\.\w+)*:\w+")


class OwnPluginError(ValueError):
    """A plugin of the user cannot be loaded."""


def own_plugin(filename: str) -> type[Plugin] | None:
    """Return the class of the user's plugin of that file name; None if no package exports it.

    :raises OwnPluginError: if it cannot be loaded.
    """
    if _CLASS.fullmatch(filename):
        return _python_plugin(filename)
    if (found := _entry_point(filename)) is not None:
        return found
    return LibraryDevice if any(each.file == _file(filename) for each in _exported_devices()) else None


def _python_plugin(name: str) -> type[Plugin]:
    """Return the class MODULE:CLASS of the package with which the module's name begins."""
    package = name.partition(":")[0].partition(".")[0]
    folder = _packages().get(package)
    if folder is None:
        raise OwnPluginError(f"there is no package {package} on ROS_PACKAGE_PATH")
    if name not in (each.get("python_plugin") for each in _exports(folder)):
        wanted = f'<export><bubblesim python_plugin="{name}"/></export>'
        raise OwnPluginError(f"{folder}/package.xml does not export it: it needs {wanted}")
    source = str(folder / "src")  # where catkin packages have their modules
    if source not in sys.path:
        sys.path.append(source)
    module, _, class_name = name.partition(":")
    try:
        return _checked(getattr(importlib.import_module(module), class_name))
    except OwnPluginError:
        raise
    except Exception as error:  # also one in the module
        raise OwnPluginError(f"it cannot be imported: {error}") from None


def _entry_point(name: str) -> type[Plugin] | None:
    found = next((each for each in entry_points(group="bubblesim.plugins") if each.name == name), None)
    if found is None:
        return None
    try:
        return _checked(found.load())
    except OwnPluginError:
        raise
    except Exception as error:
        raise OwnPluginError(f"the entry point {found.value} cannot be loaded: {error}") from None


def _checked(found: object) -> type[Plugin]:
    if isinstance(found, type) and issubclass(found, Plugin):
        return found
    raise OwnPluginError(f"it is no subclass of {Plugin.__module__}.Plugin")


@dataclass(frozen=True)
class _ExportedDevice:
    """A <class> in the file that a package exports to pluginlib."""

    package: Path  # folder
    path: str  # of the library in the file, without .so
    name: str
    kind: str  # the name of the class in C++

    @property
    def file(self) -> str:
        """Return the name by which a <plugin> names the library."""
        return _file(self.path)

    def found(self) -> Path:
        """Return the library where pluginlib searches it: in workspaces, and in and beside the package."""
        prefixes = [Path(each) for each in os.environ.get("CMAKE_PREFIX_PATH", "").split(":") if each]
        folders = [*prefixes, *(prefix / "lib" for prefix in prefixes), self.package, self.package / "lib"]
        folders.append(self.package.parent.parent / "lib")  # of share/PACKAGE
        names = [f"{self.path}.so", f"{Path(self.path).name}.so"]
        candidates = [folder / name for folder in folders for name in names]
        existing = next((each for each in candidates if each.is_file()), None)
        if existing is None:
            raise OwnPluginError(f"{self.path}.so of {self.package} is not there: build the package")
        return existing


class LibraryDevice(Plugin):
    """A device in C++, exported by a library."""

    acts_without_ros = True

    def __init__(self, context: PluginContext) -> None:
        """Load the library and make its device."""
        super().__init__(context)
        from bubblesim import _plugin_devices  # not in builds without ROS

        plugin = self.parameters.plugin
        exported = _chosen(plugin)
        file = exported.found()
        self.enter_namespace()
        try:
            library = _library(str(file))
            arguments = context.model, context.owner, plugin, self.namespace
            self._device: Any = _plugin_devices.LoadedDevice(library, exported.kind, context.simulation, *arguments)
        except RuntimeError as error:
            raise OwnPluginError(str(error)) from None
        except ValueError as error:  # with its place
            raise ParameterError(str(error)) from None
        self.parameters.ignore(*self._device.names_read)
        context.endpoints.append(self._device.remove)

    def actuate(self) -> None:
        """Report what went wrong in the last step."""
        if self._device.failure:
            raise FailedInSubstepError(self._device.failure)

    publish = actuate  # in the same step


def _chosen(plugin: Any) -> _ExportedDevice:
    """Return the device of a library; of several, that with the name of the plugin."""
    exported = [each for each in _exported_devices() if each.file == _file(plugin.filename)]
    named = [each for each in exported if plugin.name in (each.name, each.kind)]
    if len(exported) > 1 and not named:
        names = ", ".join(each.name for each in exported)
        raise OwnPluginError(f"the library has several devices: the name of the <plugin> must be one of {names}")
    return (named or exported)[0]


@cache
def _library(path: str) -> Any:
    from bubblesim import _plugin_devices

    return _plugin_devices.Library(path)


@cache
def _exported_devices() -> tuple[_ExportedDevice, ...]:
    places = [(folder, each.get("plugin")) for folder in _packages().values() for each in _exports(folder)]
    files = [(folder, Path(place.replace("${prefix}", str(folder)))) for folder, place in places if place]
    return tuple(each for folder, file in files for each in _devices_in(folder, file))


def _devices_in(package: Path, file: Path) -> Iterator[_ExportedDevice]:
    try:
        root = ElementTree.parse(file).getroot()
    except (OSError, ElementTree.ParseError) as error:
        write_line(sys.stderr, f"warning: {file}, which {package}/package.xml exports, cannot be read: {error}")
        return
    for library in root.iter("library"):
        for each in library.iterfind("class"):
            if each.get("base_class_type") == _BASE:
                kind = each.get("type", "")
                yield _ExportedDevice(package, library.get("path", ""), each.get("name", kind), kind)


@cache
def _packages() -> dict[str, Path]:
    """Return the folders of all packages; none without ROS."""
    try:
        import rospkg
    except ModuleNotFoundError:
        return {}
    found = rospkg.RosPack()
    return {name: Path(found.get_path(name)) for name in found.list()}


def _exports(package: Path) -> list[ElementTree.Element]:
    """Return the elements <bubblesim> that a package exports."""
    try:
        text = (package / "package.xml").read_text()
        return list(ElementTree.fromstring(text).iterfind("export/bubblesim")) if "<bubblesim" in text else []
    except (OSError, UnicodeDecodeError, ElementTree.ParseError):
        return []


def _file(filename: str) -> str:
    return Path(filename).name.removesuffix(".so").removeprefix("lib")
