# SPDX-License-Identifier: BSD-3-Clause
"""Other users of the machine read nothing of a run, and files that they put in its way harm nobody."""

import contextlib
import json
import os
import stat
import subprocess
import textwrap
from pathlib import Path

import pytest

import bubblesim
from every_port import ListeningNode, children
from node_support import run_sim
from page_client import Server
from ros_support import RosCore, free_port, ros_environment

NOBODY = 65534
OWN = ("home", "run", "tmp", "cache")
"""Folders for HOME, XDG_RUNTIME_DIR, TMPDIR and XDG_CACHE_HOME."""
LINKS = (
    "bash",
    "-c",
    'cd "$(dirname "${@: -1}")"; ln -s victim "state.$$.part"; ln -s victim state.part; exec "$@"',
    "-",
)
"""A shell that makes such links in the folder of the last argument, and becomes the command."""
TRY = """
    import json, os, socket, sys
    opened = []
    for path in json.load(sys.stdin):
        for flags in (os.O_RDONLY, os.O_WRONLY):
            try:
                os.close(os.open(path, flags | os.O_NONBLOCK))
                opened.append(path)
            except OSError:
                pass
        try:
            with socket.socket(socket.AF_UNIX) as connection:
                connection.connect(path)
            opened.append(path)
        except (OSError, ValueError):
            pass
    print(json.dumps(opened))
"""


def as_nobody(paths: list[str]) -> list[str]:
    """Return those of some paths that another user can read, write or connect to."""
    command = ["/usr/bin/python3", "-c", textwrap.dedent(TRY)]
    run = subprocess.run(
        command, input=json.dumps(paths), user=NOBODY, group=NOBODY, extra_groups=[], cwd="/",
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    return list(json.loads(run.stdout))


def open_to_all(folder: Path) -> None:
    """Let all users enter a folder, so that only the modes of what is in it protect."""
    for each in (folder, *folder.parents):
        if each.stat().st_uid == os.geteuid() and each != Path("/"):
            each.chmod(each.stat().st_mode | 0o755)


def own_folders(folder: Path) -> dict[str, str]:
    """Return an environment with folders of their own, which all may enter."""
    names = dict(zip(("HOME", "XDG_RUNTIME_DIR", "TMPDIR", "XDG_CACHE_HOME"), OWN, strict=True))
    for name in OWN:
        (folder / name).mkdir(mode=0o755)
    open_to_all(folder)
    return {variable: str(folder / name) for variable, name in names.items()} | {"ROS_HOME": str(folder / "home")}


def of_processes(pids: list[int]) -> list[str]:
    """Return what the kernel shows of processes: memory, environment, and their descriptors, also of shared memory."""
    kinds = ("mem", "environ", "maps")
    found = [f"/proc/{pid}/{kind}" for pid in pids for kind in kinds]
    return found + [str(each) for pid in pids for each in Path(f"/proc/{pid}/fd").iterdir()]


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can be another user")
def test_another_user_opens_nothing_that_a_run_makes(roscore: RosCore, tmp_path: Path) -> None:
    env = own_folders(tmp_path)
    shared_memory = set(Path("/dev/shm").iterdir())
    with ListeningNode(roscore, tmp_path, env=env) as node:
        with bubblesim.connect(node.ports["remote API"]) as simulator:
            simulator.sim.createScript(1, "function sysCall_init() end", 0, "lua")
            next(simulator.frames())
        made = [str(path) for name in OWN for path in (tmp_path / name).rglob("*") if not path.is_dir()]
        assert any(path.endswith("/api") for path in made), made
        assert any(path.endswith(".html") for path in made), made
        assert any(path.endswith(".lua") for path in made), made
        made += [str(path) for path in Path("/dev/shm").iterdir() if path not in shared_memory and is_of(node, path)]
        processes = of_processes([node.process.pid, *children(node.process.pid)])
        assert as_nobody([*made, *processes]) == []
        assert as_nobody(["/etc/passwd"]) == ["/etc/passwd"]
        assert node.end() == 0, node.output
    assert [path for name in OWN for path in (tmp_path / name).rglob("*") if stat.S_ISSOCK(path.stat().st_mode)] == []


def is_of(node: ListeningNode, path: Path) -> bool:
    """Return whether a process of a node has a file open."""
    for pid in (node.process.pid, *children(node.process.pid)):
        for each in Path(f"/proc/{pid}/fd").iterdir():
            with contextlib.suppress(FileNotFoundError):  # one of them is gone meanwhile
                if each.samefile(path):
                    return True
    return False


def test_a_saved_state_does_not_follow_the_link_of_another_user(tmp_path: Path) -> None:
    """Each name of a file that is being written, which others can foresee, is a link already."""
    victim, state = tmp_path / "victim", tmp_path / "state"
    victim.write_text("mine")
    state.symlink_to(victim)
    run = run_sim("ball", "--no-ros", "--speed", "max", "--until", 0.1, "--save-state", state, within=LINKS)
    assert run.returncode == 0, run.stderr
    assert victim.read_text() == "mine"
    assert not state.is_symlink()
    assert [path.name for path in tmp_path.glob("*.part") if not path.is_symlink()] == []


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can make a folder of another user")
def test_the_token_is_not_written_to_a_folder_of_another_user(tmp_path: Path) -> None:
    env = own_folders(tmp_path) | {"XDG_RUNTIME_DIR": str(tmp_path / "run")}
    taken = tmp_path / "run" / "bubblesim"
    taken.mkdir()
    os.chown(taken, NOBODY, NOBODY)
    with Server(tmp_path, env=ros_environment(free_port(), tmp_path) | env | {"BUBBLESIM_WEB_TOKEN": "t"}) as server:
        assert "belongs to another user" in server.output
    assert list(taken.iterdir()) == []
