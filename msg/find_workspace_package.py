# SPDX-License-Identifier: BSD-3-Clause
"""Print the sources folder of the catkin workspace that a build folder belongs to, and the folders of packages there.

`catkin build` configures each package alone, so CMake cannot see which others share its workspace. The output is a
CMake list, of the sources folder and one item for each package asked for; an item is empty when there is no such
package, or no workspace.
"""

import subprocess
import sys
from pathlib import Path

from catkin_pkg.packages import find_packages


def source_space(build_folder: Path) -> Path | None:
    """Folder with the workspace's sources, or None outside a workspace."""
    for folder in build_folder.parents:
        if (folder / ".catkin_tools").is_dir():
            located = subprocess.run(
                ["catkin", "locate", "--workspace", folder, "--src"], capture_output=True, text=True, check=False
            )
            return Path(located.stdout.strip()) if located.returncode == 0 else folder / "src"
        # catkin_make marks a workspace only when all is configured; a link to its own CMake file is there before.
        is_linked = (folder / "src" / "CMakeLists.txt").resolve().name == "toplevel.cmake"
        if is_linked or (folder / ".catkin_workspace").is_file():  # the latter by catkin_make_isolated, too
            return folder / "src"
    return None


def package_folders(sources: Path) -> dict[str, Path]:
    """The folder of each package below `sources`, by name."""
    return {package.name: sources / path for path, package in find_packages(sources).items()}


if __name__ == "__main__":
    workspace = source_space(Path(sys.argv[1]))
    folders = package_folders(workspace) if workspace and workspace.is_dir() else {}
    print(*[workspace or "", *(folders.get(name, "") for name in sys.argv[2:])], sep=";", end="")
