# SPDX-License-Identifier: BSD-3-Clause
"""Files of CoppeliaSim: bubblesim describe, convert, check and run."""

import functools
import math
import os
import pty
import struct
import subprocess
from pathlib import Path

import pytest

import bubblesim
from cli_support import bubblesim as program
from node_support import run_sim
from ros_support import DEADLINE, built
from ttt_files import BOX, FLOOR, LUA, PYTHON, arm, cuboid, item, joint, script, text, thing, write


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


def test_bodies_are_damped_by_the_material_for_the_engine_of_the_file(tmp_path: Path) -> None:
    bullet = item("_uN", struct.pack("<2i5d", 5, 0, 0, 1, 1, 0.5, 0.5))  # it takes half of a velocity in a second
    box = thing("SHP", 2, -1, "Box", cuboid((0.2, 0.2, 0.2), 2) + item("Mat", bullet + b"EOO"))
    simulation = bubblesim.Simulation(str(write(tmp_path / "box.ttt", box)))
    simulation.step(20)
    rate = math.log(2)  # 1/s: v' = -g - rate v
    assert simulation.world.velocity(simulation.object("/Box").handle)[0][2] == pytest.approx(
        -9.81 / rate * (1 - math.exp(-rate)), rel=5e-3
    )


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


def test_links_of_joints_are_not_damped_each_for_itself(tmp_path: Path) -> None:
    material = item("Mat", item("_uN", struct.pack("<2i5d", 5, 0, 0, 1, 1, 0.5, 0.5)) + b"EOO")
    box = thing("SHP", 13, 11, "Arm", cuboid((1, 0.05, 0.05), 1) + material)
    file = write(tmp_path / "arm.ttt", thing("JNT", 11, -1, "motor", joint(0, 0, 0)), box)
    assert program("convert", str(file), str(tmp_path / "folder")).returncode == 0
    assert "velocity_decay" not in (tmp_path / "folder" / "scene.sdf").read_text()


VISION = """sim = require'sim'
function sysCall_init() end
function sysCall_vision(data)
  return {trigger = true, packedPackets = {sim.packFloatTable({7, 8})}}
end
"""
READS = """sim = require'sim'
function sysCall_init() camera = sim.getObject('/Camera') end
function sysCall_sensing()
  local result, _, packet = sim.readVisionSensor(camera)
  if packet then print('packet', packet[1], packet[2]) end
end
"""


def test_customization_scripts_that_filter_an_image_run(tmp_path: Path) -> None:
    camera = thing("RSN", 3, -1, "Camera", item("Res", struct.pack("<2i", 2, 2)))
    filters = script(3, VISION, kind=6)
    file = write(tmp_path / "camera.ttt", FLOOR, BOX, camera, filters, script(2, READS), script(1, "error()", kind=6))
    run = run_sim(file, "--no-ros", "--speed", "max", "--until", "0.2")
    assert "packet\t7" in run.stdout or "packet 7" in run.stdout
    assert "1 x customization script: not run (Floor)" in run.stderr


FAST = ("--no-ros", "--speed", "max", "--until", "0.1")
OLD_PATH = """sim = require'sim'
function sysCall_init()
  local path = sim.getObjectHandle('Path')
  print(string.format('length %.2f', sim.getPathLength(path)))
  print(string.format('middle %.2f %.2f %.2f', unpack(sim.getPositionOnPath(path, 0.5))))
  print('data '..sim.readCustomDataBlock(path, 'mine'))
end
"""


def test_scripts_follow_paths_and_read_data_of_old_files(tmp_path: Path) -> None:
    points = b"".join(
        item("Pat", item("At2", struct.pack("<9fif", x, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 1, 1)) + b"EOO") for x in (0, 2, 4)
    )
    block = struct.pack("<2i", 8 + 5 + 3, 5) + b"mine\0abc"
    data = item("Cod", item("Dat", struct.pack("<2i", 356248756, len(block)) + block) + b"EOO")
    common = item("Ids", struct.pack("<2i", 3, -1)) + item("Cfq", struct.pack("<7f", 1, 0, 0, 0, 0, 1, 2))
    path = item("PAT", common + item("Nme", text("Path")) + data + b"NXT" + item("Ntp", points + b"EOO") + b"EOO")
    run = run_sim(write(tmp_path / "path.ttt", BOX, path, script(2, OLD_PATH)), *FAST)
    assert "length 4.00" in run.stdout
    assert "middle 2.00 1.00 2.00" in run.stdout
    assert "data abc" in run.stdout


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


def on_a_terminal(file: Path, answer: bytes) -> str:
    """Run a scene on a terminal, where this is typed; return what scripts print."""
    terminal, end = pty.openpty()
    os.write(terminal, answer)
    command = [str(built("sim")), str(file), "--no-ros", "--speed", "max", "--until", "0.1"]
    run = subprocess.run(
        command, stdin=end, stderr=end, stdout=subprocess.PIPE, text=True, timeout=3 * DEADLINE, check=False
    )
    os.close(end)
    os.close(terminal)
    return run.stdout


def test_on_a_terminal_it_is_asked_once_for_each_content_of_a_file(tmp_path: Path) -> None:
    file = write(tmp_path / "box.ttt", FLOOR, BOX, script(2, PYTHON, "python"))
    assert "python runs" not in on_a_terminal(file, b"n\n")
    assert "python runs" in on_a_terminal(file, b"y\n")
    assert "python runs" in on_a_terminal(file, b"")
    write(file, FLOOR, BOX, script(2, PYTHON + "# more\n", "python"))
    assert "python runs" not in on_a_terminal(file, b"n\n")


def test_old_conversions_make_room_for_new_ones(tmp_path: Path) -> None:
    folder = Path(os.environ["XDG_CACHE_HOME"]) / "bubblesim" / "converted"
    for age, name in enumerate(("young", "old")):
        (folder / name).mkdir(parents=True)
        with (folder / name / "large").open("wb") as large:
            large.truncate(700_000_000)  # sparse: it takes no space
        os.utime(folder / name, (1e9 - age, 1e9 - age))
    bubblesim.Simulation(str(write(tmp_path / "box.ttt", BOX)))
    left = {each.name for each in folder.iterdir()}
    assert "old" not in left
    assert "young" in left
    assert len(left) == 2
