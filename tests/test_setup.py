# SPDX-License-Identifier: BSD-3-Clause
"""scripts/setup prints on which systems it works, and what is wrong."""

import subprocess
from pathlib import Path

import pytest

from ros_support import REPOSITORY

SYSTEM = REPOSITORY / "scripts" / "environment" / "system.bash"


def check(file: Path, *, function: str = "check_system") -> tuple[int, str]:
    """Return the exit code and the words of the check for an os-release file."""
    command = f"set -euo pipefail; source '{SYSTEM}'; {function} '{file}'"
    run = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False)
    assert run.stderr == ""
    return run.returncode, run.stdout.strip()


def release(folder: Path, identity: str, version: str | None, name: str) -> Path:
    """Write an os-release file, without a version for a release in development."""
    file = folder / "os-release"
    numbered = "" if version is None else f'VERSION_ID="{version}"\n'
    file.write_text(f'PRETTY_NAME="{name}"\n{numbered}ID={identity}\n')
    return file


@pytest.mark.parametrize(("version", "name"), [("12", "bookworm"), ("13", "trixie")])
def test_nothing_is_printed_on_tested_systems(tmp_path: Path, version: str, name: str) -> None:
    file = release(tmp_path, "debian", version, f"Debian GNU/Linux {version} ({name})")
    assert check(file) == (0, "")
    assert check(file, function="system_release") == (0, f"debian-{version}")


def test_an_untested_system_is_a_warning(tmp_path: Path) -> None:
    code, words = check(release(tmp_path, "ubuntu", "24.04", "Ubuntu 24.04.3 LTS"))
    assert code == 0
    assert words.startswith("bubblesim is untested on Ubuntu 24.04.3 LTS: it is tested on Debian 12 and 13")


def test_an_old_python_is_a_reason(tmp_path: Path) -> None:
    code, words = check(release(tmp_path, "ubuntu", "22.04", "Ubuntu 22.04.5 LTS"))
    assert (code, "it needs Python 3.11, found 3.10" in words) == (3, True)


@pytest.mark.parametrize(
    ("identity", "version", "name"),
    [
        ("debian", "11", "Debian GNU/Linux 11 (bullseye)"),
        ("debian", None, "Debian GNU/Linux forky/sid"),
        ("fedora", "42", "Fedora Linux 42"),
    ],
)
def test_other_systems_are_refused_by_name(tmp_path: Path, identity: str, version: str | None, name: str) -> None:
    code, words = check(release(tmp_path, identity, version, name))
    assert (code, words.startswith(f"bubblesim does not support {name}: ")) == (3, True)


def test_a_system_without_a_name_is_refused(tmp_path: Path) -> None:
    code, words = check(tmp_path / "none")
    assert (code, f"there is no {tmp_path}/none" in words) == (3, True)


def in_a_clone(folder: Path, file: Path, *arguments: str) -> "subprocess.CompletedProcess[str]":
    """Run the setup of a copy of scripts/ on a system with this os-release file."""
    scripts = folder / "clone" / "scripts"
    (scripts / "environment").mkdir(parents=True)
    (scripts / "setup").write_text((REPOSITORY / "scripts" / "setup").read_text())
    text = SYSTEM.read_text().replace("/etc/os-release}", f"{file}}}")
    (scripts / "environment" / "system.bash").write_text(text)
    return subprocess.run(
        ["bash", str(scripts / "setup"), *arguments], capture_output=True, text=True, check=False, timeout=30
    )


def test_setup_changes_nothing_on_a_system_that_is_not_supported(tmp_path: Path) -> None:
    old = release(tmp_path, "debian", "11", "Debian GNU/Linux 11 (bullseye)")
    run = in_a_clone(tmp_path, old, "--clean")
    assert (run.returncode, run.stdout) == (3, "")
    assert "[setup] bubblesim does not support Debian GNU/Linux 11 (bullseye)" in run.stderr
    assert not (tmp_path / "clone" / ".ws").exists()


def test_anyway_goes_on(tmp_path: Path) -> None:
    old = release(tmp_path, "debian", "11", "Debian GNU/Linux 11 (bullseye)")
    run = in_a_clone(tmp_path, old, "--anyway")  # ends at the missing lists of packages
    assert "does not support Debian GNU/Linux 11" in run.stderr
    assert run.returncode not in (0, 3)
    assert (tmp_path / "clone" / ".ws").exists()


def part_of_setup(folder: Path, function: str, environment: dict[str, str]) -> str:
    """Return what one function of setup prints in a clone that has nothing else."""
    code = (REPOSITORY / "scripts" / "setup").read_text().replace("\nmain ", f"\n{function} # ")
    (folder / "scripts" / "environment").mkdir(parents=True)
    (folder / "scripts" / "setup").write_text(code)
    (folder / "scripts" / "environment" / "system.bash").write_text(SYSTEM.read_text())
    command = ["bash", str(folder / "scripts" / "setup")]
    environment = {"PATH": "/usr/bin:/bin", **environment}
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout


def test_python_is_compiled_also_where_python_writes_no_bytecode(tmp_path: Path) -> None:
    (tmp_path / "python").mkdir()
    (tmp_path / "python" / "module.py").write_text("")
    part_of_setup(tmp_path, "compile_python", {"PYTHONDONTWRITEBYTECODE": "1"})
    assert list((tmp_path / "python" / "__pycache__").glob("module.*.pyc"))


def test_each_package_of_python_for_tests_has_a_version() -> None:
    """Linters in other versions find other things."""
    lists = SYSTEM.parent
    wanted = {line for line in (lists / "requirements-tests.txt").read_text().splitlines() if not line.startswith("#")}
    given = {line.partition("==")[0] for line in (lists / "constraints.txt").read_text().splitlines() if "==" in line}
    assert wanted - given == set()


@pytest.mark.parametrize(
    ("proxy", "shown"),
    [
        ("http://proxy.example:3128", "http://proxy.example:3128"),
        ("http://user:secret@proxy.example:3128", "http://***@proxy.example:3128"),
        ("user:sec@ret/@proxy.example:3128", "***@proxy.example:3128"),
    ],
)
def test_an_error_names_the_proxies_without_their_passwords(tmp_path: Path, proxy: str, shown: str) -> None:
    configuration = tmp_path / "apt.conf"
    configuration.write_text(f'Acquire::http::Proxy "{proxy}";\n')
    printed = part_of_setup(tmp_path, "proxies", {"https_proxy": proxy, "APT_CONFIG": str(configuration)})
    assert printed == f' Set are: https_proxy={shown} Acquire::http::Proxy "{shown}";\n'
