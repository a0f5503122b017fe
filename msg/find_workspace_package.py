# SPDX-License-Identifier: BSD-3-Clause
"""Print the source folder of the catkin workspace of a build folder, and the folders of packages in it.

`catkin build` configures each package separately, so CMake does not know the other packages of the workspace. The
output is a CMake list with the source folder and one item for each requested package. An item is empty if there is no
such package or no workspace.
"""

import subprocess
import sys
from pathlib import Path

from catkin_pkg.packages import find_packages


def source_space(build_folder: Path) -> Path | None:
    """Return the source folder of the workspace, or None outside a workspace."""
    for folder in build_folder.parents:
        if (folder / ".catkin_tools").is_dir():
            located = subprocess.run(
                ["catkin", "locate", "--workspace", folder, "--src"], capture_output=True, text=True, check=False
            )
            return Path(located.stdout.strip()) if located.returncode == 0 else folder / "src"
        # catkin_make marks a workspace after configuring it; the link to its own CMake file exists before.
        is_linked = (folder / "src" / "CMakeLists.txt").resolve().name == "toplevel.cmake"
        if is_linked or (folder / ".catkin_workspace").is_file():  # also created by catkin_make_isolated
            return folder / "src"
    return None


def package_folders(sources: Path) -> dict[str, Path]:
    """Return the folder of each package below `sources`, by name."""
    return {package.name: sources / path for path, package in find_packages(sources).items()}


if __name__ == "__main__":
    workspace = source_space(Path(sys.argv[1]))
    folders = package_folders(workspace) if workspace and workspace.is_dir() else {}
    print(*[workspace or "", *(folders.get(name, "") for name in sys.argv[2:])], sep=";", end="")
