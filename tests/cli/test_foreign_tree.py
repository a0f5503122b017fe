# SPDX-License-Identifier: BSD-3-Clause
"""What scripts may do with the objects of CoppeliaSim's files: joints without physics, static shapes, names, data."""

import math
import struct
from pathlib import Path

import pytest

import bubblesim
from node_support import run_sim
from ttt_files import BOX, FLOOR, IDENTITY, arm, cuboid, item, script, text, thing, write


def kinematic(position: float, follows: int = -1, factor: float = 0, offset: float = 0) -> bytes:
    """Return the second half of a revolute joint from -2 to 2 rad that moves only when it is set, or with a leader."""
    fields = item("Jtt", struct.pack("<i", 10)) + item("_rt", struct.pack("<d", position))
    fields += item("_mr", struct.pack("<2d", -2, 4)) + item("Jmd", struct.pack("<i", 0 if follows < 0 else 4))
    return fields + item("_dt", struct.pack("<i2d", follows, factor, offset))


def at(x: float, y: float = 0, z: float = 0) -> tuple[float, ...]:
    return (1, 0, 0, 0, x, y, z)


PLATE = cuboid((0.2, 0.2, 0.02))
CRANE = (
    thing("SHP", 40, -1, "Mast", cuboid((0.1, 0.1, 1)), at(0, 0, 0.5))
    + thing("JNT", 41, 40, "turn", kinematic(0.5))
    + thing("SHP", 42, 41, "Boom", cuboid((1, 0.1, 0.1)), at(0.5))
    + thing("DMY", 43, 42, "hook", b"", at(0.5))
    + thing("JNT", 44, 40, "follower", kinematic(0, 41, 2, 0.1), at(0, 2))
    + thing("SHP", 45, 44, "Flag", PLATE, at(1))
)


def run_script(tmp_path: Path, *parts: bytes, steps: str = "0.2") -> tuple[str, str]:
    """Run a scene with its scripts; return what they print, and the warnings and errors."""
    run = run_sim(write(tmp_path / "scene.ttt", *parts), "--no-ros", "--speed", "max", "--until", steps)
    return run.stdout, run.stderr


def test_a_kinematic_joint_moves_what_is_below_it_when_it_is_set(tmp_path: Path) -> None:
    simulation = bubblesim.Simulation(str(write(tmp_path / "crane.ttt", CRANE)))
    world = simulation.world
    turn, hook, boom = (world.find(path) for path in ("/Mast/turn", "/Mast/turn/Boom/hook", "/Mast/turn/Boom"))
    assert world.joint_position(turn) == 0.5
    assert world.pose(hook)[:3] == pytest.approx((math.cos(0.5), math.sin(0.5), 0.5), abs=1e-9)
    world.set_joint_position(turn, 1.2)
    assert world.pose(boom)[:3] == pytest.approx((0.5 * math.cos(1.2), 0.5 * math.sin(1.2), 0.5), abs=1e-9)
    assert world.pose(hook)[:3] == pytest.approx((math.cos(1.2), math.sin(1.2), 0.5), abs=1e-9)
    assert world.pose_in(boom, turn)[:3] == pytest.approx((0.5, 0, 0), abs=1e-9)
    simulation.step(3)
    assert world.joint_position(turn) == 1.2


def test_a_kinematic_joint_stops_at_its_limits(tmp_path: Path) -> None:
    world = bubblesim.Simulation(str(write(tmp_path / "crane.ttt", CRANE))).world
    turn = world.find("/Mast/turn")
    world.set_joint_position(turn, 3)
    assert world.joint_position(turn) == 2
    assert world.joint_limits(turn) == (-2, 2)


def test_a_dependent_joint_follows_its_leader(tmp_path: Path) -> None:
    world = bubblesim.Simulation(str(write(tmp_path / "crane.ttt", CRANE))).world
    world.set_joint_position(world.find("/turn"), 0.7)
    assert world.joint_position(world.find("/follower")) == pytest.approx(2 * 0.7 + 0.1)
    flag = world.pose(world.find("/Flag"))
    assert flag[:3] == pytest.approx((math.cos(1.5), 2 + math.sin(1.5), 0.5), abs=1e-9)


def test_a_reset_brings_kinematic_joints_and_static_shapes_back(tmp_path: Path) -> None:
    simulation = bubblesim.Simulation(str(write(tmp_path / "crane.ttt", CRANE, FLOOR, BOX)))
    world = simulation.world
    before = simulation.state_hash()
    world.set_joint_position(world.find("/turn"), 1.2)
    world.set_pose(world.find("/Mast"), [1, 1, 1, 0, 0, 0, 1])
    assert simulation.state_hash() != before
    simulation.reset()
    assert simulation.state_hash() == before
    assert world.joint_position(world.find("/turn")) == 0.5
    assert world.pose(world.find("/Boom"))[:2] == pytest.approx((0.5 * math.cos(0.5), 0.5 * math.sin(0.5)), abs=1e-9)


def test_a_snapshot_has_kinematic_joints_and_static_shapes(tmp_path: Path) -> None:
    simulation = bubblesim.Simulation(str(write(tmp_path / "crane.ttt", CRANE)))
    world = simulation.world
    world.set_joint_position(world.find("/turn"), 1.2)
    world.set_pose(world.find("/Mast"), [1, 1, 1, 0, 0, 0, 1])
    saved, state = simulation.save(), simulation.state_hash()
    world.set_joint_position(world.find("/turn"), -1)
    simulation.restore(saved)
    assert simulation.state_hash() == state
    assert world.joint_position(world.find("/turn")) == 1.2
    hook = world.pose(world.find("/hook"))
    assert hook[:3] == pytest.approx((1 + math.cos(1.2), 1 + math.sin(1.2), 1), abs=1e-9)


def test_bodies_rest_on_a_static_shape_where_it_was_moved(tmp_path: Path) -> None:
    table = thing("SHP", 3, -1, "Table", cuboid((1, 1, 0.1)), at(5, 0, 0.2))
    simulation = bubblesim.Simulation(str(write(tmp_path / "table.ttt", FLOOR, BOX, table)))
    world = simulation.world
    world.set_pose(world.find("/Table"), [0, 0, 0.2, 0, 0, 0, 1])
    simulation.step(60)
    assert world.pose(world.find("/Box"))[2] == pytest.approx(0.2 + 0.05 + 0.1, abs=2e-3)
    world.set_pose(world.find("/Table"), [5, 0, 0.2, 0, 0, 0, 1])
    simulation.step(60)
    assert world.pose(world.find("/Box"))[2] == pytest.approx(0.1, abs=2e-3)


def test_a_static_shape_on_a_kinematic_joint_of_a_robot_moves_with_the_robot(tmp_path: Path) -> None:
    head = thing("JNT", 20, 2, "neck", kinematic(0), at(0, 0, 0.2)) + thing("SHP", 21, 20, "Head", PLATE, at(0.3))
    simulation = bubblesim.Simulation(str(write(tmp_path / "robot.ttt", FLOOR, BOX, head)))
    world = simulation.world
    box, plate = world.find("/Box"), world.find("/Box/neck/Head")
    simulation.step(60)  # it falls on the floor
    assert world.pose_in(plate, box)[:3] == pytest.approx((0.3, 0, 0.2), abs=1e-6)
    world.set_joint_position(world.find("/neck"), math.pi / 2)
    assert world.pose_in(plate, box)[:3] == pytest.approx((0, 0.3, 0.2), abs=1e-6)
    world.set_pose(box, [1, 0, 1, 0, 0, 0, 1])
    simulation.step(60)
    assert world.pose(box)[2] == pytest.approx(0.1, abs=2e-3)
    assert world.pose_in(plate, box)[:3] == pytest.approx((0, 0.3, 0.2), abs=1e-6)


ATTACH = """sim=require'sim'
function sysCall_init()
  plate, box = sim.getObject('/Plate'), sim.getObject('/Box')
  sim.setObjectParent(plate, box, true)
end
function sysCall_sensing()
  if sim.getSimulationTime() > 0.5 and plate then
    print('apart', sim.getObjectPosition(plate, box)[3])
    sim.setObjectParent(plate, -1, true)
    sim.setObjectPosition(plate, {3, 0, 1})
    plate = nil
  end
end
"""


def test_scripts_attach_static_shapes_to_bodies_and_detach_them(tmp_path: Path) -> None:
    plate = thing("SHP", 3, -1, "Plate", PLATE, at(0, 0, 1))
    out, errors = run_script(tmp_path, FLOOR, BOX, plate, script(2, ATTACH), steps="1")
    assert "apart\t0.5" in out or "apart 0.5" in out
    assert "error" not in errors


MODES = """sim=require'sim'
function sysCall_init()
  local turn, motor = sim.getObject('/Mast/turn'), sim.getObject('/Base/motor')
  print('type', sim.getObjectType(turn) == sim.object_joint_type, sim.getJointMode(turn) == sim.jointmode_kinematic)
  sim.setJointMode(turn, sim.jointmode_passive, 0)
  sim.setJointPosition(turn, -0.25)
  print('at', sim.getJointPosition(turn))
  sim.setJointMode(motor, sim.jointmode_kinematic, 0)
  sim.setJointPosition(motor, 1.0)
end
function sysCall_sensing()
  if sim.getSimulationTime() > 0.3 then
    print(string.format('held %.3f', sim.getJointPosition(sim.getObject('/Base/motor'))))
  end
end
"""


def test_scripts_set_kinematic_joints_and_hold_dynamic_ones(tmp_path: Path) -> None:
    out, errors = run_script(tmp_path, CRANE, arm(0.5, 4, 2.0), script(12, MODES), steps="0.5")
    assert "type\ttrue\ttrue" in out or "type true true" in out
    assert "at\t-0.25" in out or "at -0.25" in out
    assert "held 1.000" in out
    assert "error" not in errors


def named(handle: int, alias: str, old_name: str, parent: int = -1) -> bytes:
    """Return a dummy with an old name beside its alias."""
    common = item("Ids", struct.pack("<2i", handle, parent)) + item("_fq", struct.pack("<7d", *IDENTITY))
    names = item("Nme", text(old_name)) + item("Ali", text(alias))
    return item("DMY", common + names + b"NXTEOO")


OLD_NAMES = """sim=require'sim'
function sysCall_init()
  local handle = sim.getObjectHandle
  print('own', handle('eye') == sim.getObject('/robot[1]/eye'), handle('eye#') == sim.getObject('/robot[0]/eye'))
  print('first', handle('eye#0') == sim.getObject('/robot[1]/eye'), sim.getObjectName(handle('eye#0')))
end
"""


def test_old_names_with_a_number_lead_to_their_objects(tmp_path: Path) -> None:
    parts = named(30, "robot", "robot"), named(31, "eye", "eye", 30), named(32, "robot", "robot#0")
    out, errors = run_script(tmp_path, *parts, named(33, "eye", "eye#0", 32), script(32, OLD_NAMES))
    words = out.replace("\t", " ")
    assert "own true true" in words
    assert "first true eye#0" in words
    assert "error" not in errors


PATHS = """sim=require'sim'
function sysCall_init()
  local paths = {'/Wall (left)', ':/turn', './hook', '../../turn'}
  for _, path in ipairs(paths) do print(path, sim.getObject(path, {noError = true}) >= 0) end
end
"""


def test_paths_keep_the_signs_of_names(tmp_path: Path) -> None:
    wall = thing("SHP", 3, -1, "Wall (left)", PLATE)
    out, _ = run_script(tmp_path, CRANE, wall, script(42, PATHS))
    assert out.count("true") == 4


def with_data(name: str, data: bytes, parameter: tuple[str, str, str]) -> bytes:
    """Return a static shape with custom data and a parameter of its script."""
    common = item("Ids", struct.pack("<2i", 5, -1)) + item("_fq", struct.pack("<7d", *IDENTITY))
    block = item("Cdt", text(name) + struct.pack("<i", len(data)) + data)
    values = struct.pack("<i", 1) + b"".join(map(text, parameter)) + struct.pack("<i", 0)
    common += item("Ali", text("Store")) + item("Cda", block + b"EOO") + item("Lsp", item("Par", values) + b"EOO")
    return item("SHP", common + b"NXT" + PLATE + b"EOO")


def test_data_and_parameters_of_the_file_are_there(tmp_path: Path) -> None:
    data = bytes(range(256))
    world = bubblesim.Simulation(
        str(write(tmp_path / "data.ttt", with_data("tag", data, ("speed", "m/s", "0.5"))))
    ).world
    store = world.find("/Store")
    assert world.file_data(store) == {"tag": data}
    assert world.script_parameters(store) == [("speed", "m/s", "0.5")]


READ_DATA = """sim=require'sim'
function sysCall_init()
  print('read', sim.readCustomDataBlock(sim.getObject('.'), 'tag'), sim.readCustomDataBlock(sim.getObject('.'), 'no'))
  sim.writeCustomDataBlock(sim.getObject('.'), 'tag', 'other')
  print('read', sim.readCustomStringData(sim.getObject('.'), 'tag'))
end
"""


def test_scripts_read_and_replace_the_data_of_the_file(tmp_path: Path) -> None:
    out, errors = run_script(tmp_path, with_data("tag", b"hello", ("a", "", "1")), script(5, READ_DATA))
    words = out.replace("\t", " ")
    assert "read hello nil" in words
    assert "read other" in words
    assert "error" not in errors
