# SPDX-License-Identifier: BSD-3-Clause
"""Locations of packages."""

from __future__ import annotations

import sys
from pathlib import Path
from xml.etree import ElementTree

import rospkg


class PackageNotFoundError(LookupError):
    """The package was not found."""


def get_package_share_directory(package_name: str) -> str:
    """Return the folder of a package: from ROS_PACKAGE_PATH, or a parent folder of the file that xacro expands."""
    try:
        return str(rospkg.RosPack().get_path(package_name))
    except rospkg.ResourceNotFound as error:
        for folder in Path(sys.argv[1]).resolve().parents if len(sys.argv) > 1 else []:
            if _name_in(folder / "package.xml") == package_name:
                return str(folder)
        raise PackageNotFoundError(
            f"package '{package_name}' not found; ROS_PACKAGE_PATH is {rospkg.get_ros_package_path()}"
        ) from error


def _name_in(manifest: Path) -> str | None:
    try:
        return ElementTree.parse(manifest).getroot().findtext("name")
    except (OSError, ElementTree.ParseError):
        return None
