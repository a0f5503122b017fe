# SPDX-License-Identifier: BSD-3-Clause
"""The generator, run as from CMake."""

import subprocess
from dataclasses import dataclass
from pathlib import Path

from ros_support import REPOSITORY


@dataclass
class Generator:
    """A test's type lists and output folder."""

    folder: Path

    @property
    def output(self) -> Path:
        """Return the folder of the generated files."""
        return self.folder / "build" / "tables"

    def run(self, messages: str, services: str = "", *options: str) -> subprocess.CompletedProcess[str]:
        """Generate from the strings of two lists."""
        meta = self.folder / "meta"
        meta.mkdir(exist_ok=True)
        (meta / "messages.txt").write_text(messages)
        (meta / "services.txt").write_text(services)
        lists = ["--messages", meta / "messages.txt", "--services", meta / "services.txt", "--output", self.output]
        return subprocess.run(
            ["/usr/bin/python3", REPOSITORY / "meta" / "generate.py", *lists, *options],
            cwd=self.folder,
            capture_output=True,
            text=True,
            check=False,
        )

    def table(self, package: str) -> str:
        """Return the generated text of a package."""
        return (self.output / f"package_{package}.cpp").read_text()

    def add_package(self, space: str, name: str, files: dict[str, str]) -> Path:
        """Write a user package in a folder of the test."""
        package = self.folder / space / name
        for file, text in {"package.xml": f"<package><name>{name}</name></package>", **files}.items():
            (package / file).parent.mkdir(parents=True, exist_ok=True)
            (package / file).write_text(text)
        return package
