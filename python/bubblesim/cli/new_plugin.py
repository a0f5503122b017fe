# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim new-plugin: create a package with a plugin of one's own, its model and its tests."""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path
from typing import Any

_TEMPLATES = Path(__file__).with_name("templates")
_NAME = re.compile(r"[a-z][a-z0-9_]*")  # of a package
_COMMON = {"models/NAME.sdf": "plugin/model.sdf.in", "test/test_NAME.py": "plugin/test.py.in"}
_FILES = {
    "cpp": {
        "package.xml": "plugin_cpp/package.xml.in",
        "CMakeLists.txt": "plugin_cpp/CMakeLists.txt.in",
        "plugins.xml": "plugin_cpp/plugins.xml.in",
        "src/plugin.cpp": "plugin_cpp/plugin.cpp.in",
        **_COMMON,
    },
    "python": {
        "package.xml": "plugin_python/package.xml.in",
        "CMakeLists.txt": "plugin_python/CMakeLists.txt.in",
        "setup.py": "plugin_python/setup.py.in",
        "src/NAME/__init__.py": "plugin_python/__init__.py.in",
        "src/NAME/plugin.py": "plugin_python/plugin.py.in",
        **_COMMON,
    },
}
_NEXT = {
    "cpp": "build it in your workspace, source its setup.bash, then: bubblesim test {folder}/test",
    "python": "try it: ROS_PACKAGE_PATH={parent}:$ROS_PACKAGE_PATH bubblesim test {folder}/test",
}


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "new-plugin",
        help="create a package with a plugin of your own",
        description="Writes the ROS package NAME: a plugin that pushes a link as a topic commands, a model with it "
        "and tests. It works without changes.",
        epilog="example: cd ~/catkin_ws/src && bubblesim new-plugin thruster --cpp && catkin build thruster",
    )
    parser.add_argument("name", metavar="NAME", help="lower-case letters, digits and underscores")
    kinds = parser.add_mutually_exclusive_group(required=True)
    kinds.add_argument(
        "--cpp", dest="kind", action="store_const", const="cpp", help="in C++: called before each physics substep"
    )
    kinds.add_argument(
        "--python", dest="kind", action="store_const", const="python", help="in Python: called in each simulation step"
    )
    parser.add_argument("--folder", type=Path, default=Path(), metavar="DIR", help="output folder (default: current)")
    parser.set_defaults(command=_make, parser=parser)


def _make(options: argparse.Namespace) -> int:
    name: str = options.name
    if not _NAME.fullmatch(name):
        hint = "; its folder is given by --folder" if "/" in name else ""
        raise ValueError(
            f"'{name}' is not a valid package name: use a lower-case letter, then lower-case letters, digits and "
            f"underscores{hint}"
        )
    package: Path = options.folder / name
    if package.exists():
        raise ValueError(f"{package} already exists: choose another name, or another folder with --folder")
    class_name = "".join(part.capitalize() for part in name.split("_"))
    filename = f"lib{name}.so" if options.kind == "cpp" else f"{name}.plugin:{class_name}"
    for place, template in _FILES[options.kind].items():
        file = package / place.replace("NAME", name)
        text = (_TEMPLATES / template).read_text().replace("@FILENAME@", filename)
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text.replace("@CLASS@", class_name).replace("@NAME@", name))
        except OSError as error:
            raise ValueError(f"cannot write {file}: {error.strerror}") from None
        print(file)
    print(_NEXT[options.kind].format(folder=package, parent=package.parent.resolve()), file=sys.stderr)
    return 0
