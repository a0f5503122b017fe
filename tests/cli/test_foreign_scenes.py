# SPDX-License-Identifier: BSD-3-Clause
"""Files of CoppeliaSim: bubblesim describe, convert, check and run."""

import functools
import math
import os
import struct
from pathlib import Path

import pytest

import bubblesim
from cli_support import bubblesim as program
from node_support import run_sim
from ros_support import REPOSITORY

IDENTITY = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@pytest.fixture(autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep conversions out of the user's cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))


def item(tag: str, content: bytes) -> bytes:
    return tag.encode() + struct.pack("<i", len(content)) + content


def text(value: str) -> bytes:
    return struct.pack("<i", len(value)) + value.encode()


def thing(tag: str, handle: int, parent: int, alias: str, own: bytes, pose: tuple[float, ...] = IDENTITY) -> bytes:
    """Return an object; the pose is w x y z and then x y z."""
    common = item("Ids", struct.pack("<2i", handle, parent)) + item("_fq", struct.pack("<7d", *pose))
    return item(tag, common + item("Ali", text(alias)) + b"NXT" + own + b"EOO")


def cuboid(size: tuple[float, float, float], mass: float | None = None) -> bytes:
    """Return the second half of a cuboid, static without a mass; its inertia is that of a homogeneous one."""
    x, y, z = size
    moments = ((y * y + z * z) / 12, (x * x + z * z) / 12, (x * x + y * y) / 12)
    matrix = (moments[0], 0, 0, 0, moments[1], 0, 0, 0, moments[2])
    body = item("_as", struct.pack("<d", mass or 0)) + item("Com", bytes(24)) + item("Imx", struct.pack("<9d", *matrix))
    mesh = item("_pr", struct.pack("<i3d", 3, *size))
    shape = item("Ge2", item("Gst", body + b"EOO" + mesh + b"EOO") + b"EOO")
    return shape + item("Sss", bytes([0x80 if mass else 0])) + item("Ss3", b"\1") + item("Dc2", b"\xff\xff")


def joint(position: float, control: int, target: float) -> bytes:
    """Return the second half of a revolute joint in dynamic mode, from -2 to 2 rad."""
    return (
        item("Jtt", struct.pack("<i", 10))
        + item("_rt", struct.pack("<d", position))
        + item("_mr", struct.pack("<2d", -2, 4))
        + item("Jmd", struct.pack("<i", 5))
        + item("Dcm", struct.pack("<i", control))
        + item("_mp", struct.pack("<2d", target, 100))
        + item("_tp", struct.pack("<d", target))
    )


def obscured(script: str) -> bytes:
    """Return the text as the format has it: the inverse of the rule by which it is read."""
    data = bytearray(script.encode())
    signed = [value - 256 if value > 127 else value for value in (data[0], data[-1])]
    s, e = int(signed[0] / 2), 3 * signed[1]
    for i in range(1, len(data) - 1):
        change = (i + s + e if i & 1 else 0) - (3 * i + s if i & 2 else 0) + (i // 2 + e if i & 4 else 0)
        data[i] = (data[i] - change) % 256
    return bytes(data)


def script(owner: int, content: str, language: str = "lua", kind: int = 1) -> bytes:
    fields = item("Si2", struct.pack("<3i", 900 + owner + kind, owner, kind)) + item("Ste", obscured(content))
    return item("LST", fields + item("Va2", b"\x08") + item("Lne", text(language)) + b"EOO")


def write(file: Path, *parts: bytes) -> Path:
    """Write a scene that is not packed."""
    content = b"".join(parts) + item("ENV", b"EOO") + b"EOF"
    header = b"VREP" + struct.pack("<iiBiiH", 25, 24, 0, len(content), 0, 41000)
    file.write_bytes(header.ljust(1021, b"\0") + content)
    return file


FLOOR = thing("SHP", 1, -1, "Floor", cuboid((5, 5, 0.1)), (1, 0, 0, 0, 0, 0, -0.05))
BOX = thing("SHP", 2, -1, "Box", cuboid((0.2, 0.2, 0.2), 2), (1, 0, 0, 0, 0, 0, 0.5))
LUA = "sim=require'sim'\nfunction sysCall_init()\n  print('it is '..sim.getObjectAlias(sim.getObject('.')))\nend\n"
PYTHON = "def sysCall_init():\n    print('python runs')\n"


def arm(position: float, control: int, target: float) -> bytes:
    """Return a static base and an arm of 1 m that turns about the vertical."""
    return (
        thing("SHP", 10, -1, "Base", cuboid((0.1, 0.1, 0.1)))
        + thing("JNT", 11, 10, "motor", joint(position, control, target))
        + thing("SHP", 12, 11, "Arm", cuboid((1, 0.05, 0.05), 1), (1, 0, 0, 0, 0.5, 0, 0))
    )


def test_a_box_falls_on_the_floor(tmp_path: Path) -> None:
    simulation = bubblesim.Simulation(str(write(tmp_path / "box.ttt", FLOOR, BOX)))
    box = simulation.object("/Box")
    simulation.step(1)
    assert box.position[2] == pytest.approx(0.5 - 9.81 * 0.05**2 / 2, abs=2e-3)
    simulation.step(40)
    assert box.position[2] == pytest.approx(0.1, abs=2e-3)


def test_a_joint_starts_at_its_position_in_the_file(tmp_path: Path) -> None:
    simulation = bubblesim.Simulation(str(write(tmp_path / "arm.ttt", arm(0.5, 0, 0))))
    assert simulation.object("/Base/motor").joint_position == pytest.approx(0.5, abs=1e-9)
    arm_position = simulation.object("/Base/motor/Arm").position
    assert arm_position[:2] == pytest.approx((0.5 * math.cos(0.5), 0.5 * math.sin(0.5)), abs=1e-9)


WALK = """sim=require'sim'
function sysCall_init()
  local own = sim.getObject('.')
  print(sim.getObjectAlias(own)..' in '..sim.getObjectAlias(sim.getObjectParent(own)))
  print(own == sim.getObject('/Base/motor/Arm/Tip'), sim.getObject('/Base/motor/Arm/Cover') >= 0)
end
"""


def test_scripts_see_the_tree_of_the_file(tmp_path: Path) -> None:
    tip = thing("DMY", 20, 12, "Tip", b"")
    cover = thing("SHP", 21, 12, "Cover", cuboid((0.1, 0.1, 0.1)))
    file = write(tmp_path / "tree.ttt", arm(0.5, 0, 0), tip, cover, script(20, WALK))
    run = run_sim(file, "--no-ros", "--speed", "max", "--until", "0.1")
    assert run.stderr.count("error") == 0
    assert "Tip in Arm\n" in run.stdout
    assert "true\ttrue" in run.stdout or "true true" in run.stdout


def test_a_motor_holds_its_target_of_the_file(tmp_path: Path) -> None:
    simulation = bubblesim.Simulation(str(write(tmp_path / "arm.ttt", arm(0.5, 8, -0.25))))
    simulation.step(60)
    assert simulation.object("/Base/motor").joint_position == pytest.approx(-0.25, abs=1e-3)


def test_what_convert_writes_is_the_same_scene(tmp_path: Path) -> None:
    file = write(tmp_path / "arm.ttt", FLOOR, BOX, arm(0.5, 8, 1.0))
    run = program("convert", str(file), str(tmp_path / "folder"))
    assert (run.returncode, run.stdout) == (0, f"{tmp_path / 'folder' / 'scene.sdf'}\n")
    hashes = []
    for scene in (file, tmp_path / "folder" / "scene.sdf"):
        simulation = bubblesim.Simulation(str(scene))
        simulation.step(20)
        hashes.append(simulation.state_hash())
    assert hashes[0] == hashes[1]


def test_convert_leaves_folders_with_files_alone(tmp_path: Path) -> None:
    file = write(tmp_path / "box.ttt", BOX)
    run = program("convert", str(file), str(tmp_path))
    assert run.returncode == 2
    assert "not an empty folder" in run.stderr


def test_describe_shows_the_tree_the_scripts_and_what_is_left_out(tmp_path: Path) -> None:
    graph = thing("GRH", 3, 2, "Graph", b"")
    file = write(tmp_path / "box.ttt", FLOOR, BOX, graph, script(2, LUA), script(2, "--x", kind=6))
    run = program("describe", str(file))
    assert run.returncode == 0
    assert "    Box: shape of 2 kg, respondable" not in run.stdout
    assert "  Box: shape of 2 kg, respondable" in run.stdout
    assert "    Graph: graph" in run.stdout
    assert "child script of Box, Lua, 5 lines" in run.stdout
    assert "1 x graph: not shown (Graph)" in run.stdout
    assert "1 x customization script: not run (Box)" in run.stdout


@pytest.mark.parametrize(
    ("content", "reported"),
    [(b"", "empty"), (b"<sdf/>", "VREP"), (b"VREP" + bytes(2000), "version 0")],
    ids=["empty", "text", "zeros"],
)
def test_other_files_are_refused_with_the_place(tmp_path: Path, content: bytes, reported: str) -> None:
    file = tmp_path / "bad.ttt"
    file.write_bytes(content)
    for command in (("describe", str(file)), ("check", str(file)), ("convert", str(file), str(tmp_path / "out"))):
        run = program(*command)
        assert run.returncode == 2
        assert "at byte" in run.stdout + run.stderr
        assert reported in run.stdout + run.stderr


def test_a_conversion_is_kept_in_the_cache_of_the_user(tmp_path: Path) -> None:
    file = write(tmp_path / "box.ttt", FLOOR, BOX)
    for _ in range(2):  # the second run takes what the first one made
        run = run_sim(file, "--no-ros", "--until", "0", env=os.environ | {"XDG_CACHE_HOME": str(tmp_path)})
        assert run.returncode == 0
        (folder,) = (tmp_path / "bubblesim" / "converted").iterdir()
        assert (folder / "scene.sdf").is_file()
        assert folder.parent.stat().st_mode & 0o077 == 0


def test_the_conversion_of_another_file_with_the_same_key_is_not_taken(tmp_path: Path) -> None:
    file = write(tmp_path / "box.ttt", FLOOR, BOX)
    sim = functools.partial(
        run_sim, file, "--no-ros", "--until", "0", env=os.environ | {"XDG_CACHE_HOME": str(tmp_path)}
    )
    assert sim().returncode == 0
    (folder,) = (tmp_path / "bubblesim" / "converted").iterdir()
    (folder / "box.ttt").write_bytes(b"another file")
    (folder / "scene.sdf").write_text("its scene")
    assert sim().returncode == 0
    assert (folder / "box.ttt").read_bytes() == file.read_bytes()


def test_without_a_home_the_error_names_what_to_set(tmp_path: Path) -> None:
    file = write(tmp_path / "box.ttt", FLOOR, BOX)
    home = {name: value for name, value in os.environ.items() if name not in ("HOME", "XDG_CACHE_HOME")}
    run = run_sim(file, "--no-ros", "--until", "0", env=home)
    assert run.returncode == 2
    assert "set HOME or XDG_CACHE_HOME" in run.stderr


def test_check_takes_it(tmp_path: Path) -> None:
    file = write(tmp_path / "box.ttt", FLOOR, BOX)
    assert program("check", str(file)).stdout == f"{file}: fine\n"


def test_lua_scripts_run_and_are_named(tmp_path: Path) -> None:
    file = write(tmp_path / "box.ttt", FLOOR, BOX, script(2, LUA))
    run = run_sim(file, "--no-ros", "--speed", "max", "--until", "0.1")
    assert "it is Box" in run.stdout
    assert "info: script of /Box:" in run.stderr
    assert "(Lua, in the sandbox)" in run.stderr


def test_python_scripts_run_only_if_that_is_allowed(tmp_path: Path) -> None:
    file = write(tmp_path / "box.ttt", FLOOR, BOX, script(2, PYTHON, "python"))
    run = run_sim(file, "--no-ros", "--speed", "max", "--until", "0.1")
    assert "python runs" not in run.stdout
    assert "--allow-python-scripts" in run.stderr
    run = run_sim(file, "--no-ros", "--speed", "max", "--until", "0.1", "--allow-python-scripts")
    assert "python runs" in run.stdout


def public_files() -> list[Path]:
    """Return public files, if there are any beside the project."""
    folders = [folder / "shared" / "ttt" for folder in (REPOSITORY.parent, REPOSITORY.parent.parent)]
    files = [file for folder in folders for suffix in ("ttt", "ttm") for file in folder.rglob(f"*.{suffix}")]
    return sorted(file for file in set(files) if file.stat().st_size > 0)


@pytest.mark.parametrize("file", public_files(), ids=lambda file: f"{file.parent.name}/{file.name}")
def test_public_files_keep_together(file: Path) -> None:
    simulation = bubblesim.Simulation(str(file))
    simulation.step(max(1, round(1 / simulation.time_step)))
    links = [each for each in simulation.objects if each.kind == "link"]
    assert all(max(map(abs, link.position)) < 1e3 for link in links)
    assert links or "simROS2" in file.parent.name  # scenes with scripts only
