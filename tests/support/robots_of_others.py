# SPDX-License-Identifier: BSD-3-Clause
"""What the packages of others' robots need besides."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from node_support import write

# Packages of sensors that the robots do not carry, whose files their descriptions include all the same.
NOT_MOUNTED = {
    "fath_pivot_mount_description": ["lockmount.urdf.xacro"],
    "flir_camera_description": ["flir_blackflys.urdf.xacro"],
    "realsense2_description": ["_d435.urdf.xacro"],
    "velodyne_description": ["VLP-16.urdf.xacro", "HDL-32E.urdf.xacro"],
}
EMPTY = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"/>'


def add_packages(folder: Path, packages: Mapping[str, Sequence[str]]) -> None:
    """Write packages with empty xacro files."""
    for package, files in packages.items():
        (folder / package / "urdf").mkdir(parents=True)
        write(folder / package / "package.xml", f"<package><name>{package}</name></package>")
        for name in files:
            write(folder / package / "urdf" / name, EMPTY)
