# SPDX-License-Identifier: BSD-3-Clause
"""Arguments of roslaunch that its file does not have: roslaunch ignores them without a word."""

from __future__ import annotations

import difflib
import os
from pathlib import Path
from xml.etree import ElementTree

from bubblesim.messages.names import did_you_mean


def command_of_roslaunch() -> list[str]:
    """Return the arguments of the roslaunch that has started this process; empty if there is none."""
    process = os.getppid()
    while process > 1:
        folder = Path("/proc", str(process))
        command = (folder / "cmdline").read_text(errors="replace").split("\0")[:-1]
        names = [Path(word).name for word in command[:3]]  # an interpreter may come first, with an option
        if "roslaunch" in names:
            return command[names.index("roslaunch") + 1 :]
        process = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
    return []


def unknown_argument(command: list[str], launch_folder: Path) -> str | None:
    """Return what is wrong with `roslaunch bubblesim FILE NAME:=VALUE ...`; None for other packages and files.

    :param launch_folder: of bubblesim. The files in its folder `include` get the arguments of those that include them.
    """
    words = [word for word in command if not word.startswith("-") and ":=" not in word]
    file = launch_folder / words[1] if len(words) == 2 else launch_folder / "none"
    if words[:1] != ["bubblesim"] or not file.is_file():
        return None
    known = sorted(
        element.attrib["name"]
        for part in (file, *launch_folder.glob("include/*.xml"))
        for element in ElementTree.parse(part).getroot().iterfind("arg")
        if "default" in element.attrib or (part == file and "value" not in element.attrib)
    )
    given = [word.split(":=")[0] for word in command if ":=" in word and not word.startswith("_")]
    for name in given:
        if name not in known:
            near = did_you_mean(difflib.get_close_matches(name, known, n=1, cutoff=0.75))
            return f"{file.name} has no argument {name}{near or '; it has ' + ', '.join(dict.fromkeys(known))}"
    return None
