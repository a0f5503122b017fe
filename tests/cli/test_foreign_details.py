# SPDX-License-Identifier: BSD-3-Clause
"""Details of files of CoppeliaSim: velocities, gains of motors, collections, both sides of flat surfaces."""

import math
import struct
from pathlib import Path

import pytest

import bubblesim
from cli_support import bubblesim as program
from node_support import run_sim
from ttt_files import BOX, FLOOR, arm, arrays, cuboid, item, joint, mesh, script, text, thing, write


def thrown(*velocity: float) -> bytes:
    """Return a box that starts with a velocity, of which SDFormat's <state> has the same numbers."""
    own = cuboid((0.2, 0.2, 0.2), 2) + item("_dv", struct.pack("<6d", *velocity))
    return thing("SHP", 2, -1, "Box", own, (1, 0, 0, 0, 0, 0, 5))


def test_a_body_starts_with_the_velocity_of_the_file(tmp_path: Path) -> None:
    simulation = bubblesim.Simulation(str(write(tmp_path / "box.ttt", thrown(1, 2, 3, 0, 0, 4))))
    box = simulation.object("/Box")
    start = simulation.state_hash()
    assert box.linear_velocity == pytest.approx([1, 2, 3])
    assert box.angular_velocity == pytest.approx([0, 0, 4])
    simulation.step(4)  # 0.2 s
    assert box.position[:2] == pytest.approx([0.2, 0.4], abs=1e-6)
    assert 2 * math.asin(box.orientation[2]) == pytest.approx(0.8, abs=1e-6)
    simulation.reset()
    assert simulation.state_hash() == start


def test_a_velocity_below_the_centre_of_mass_is_that_of_the_centre(tmp_path: Path) -> None:
    own = cuboid((0.2, 0.2, 0.2), 2).replace(item("Com", bytes(24)), item("Com", struct.pack("<3d", 0.05, 0, 0)))
    box = thing("SHP", 2, -1, "Box", own + item("_dv", struct.pack("<6d", 0, 0, 0, 0, 0, 4)))
    simulation = bubblesim.Simulation(str(write(tmp_path / "box.ttt", box)))
    assert simulation.object("/Box").linear_velocity == pytest.approx([0, -0.2, 0])


def gains(p: float, i: float, d: float) -> bytes:
    """Return the block for ODE, which ends with the gains of position control."""
    return item("_dN", struct.pack("<2i8d", 8, 0, 0.6, 1e-5, 0, 1, 1e-5, p, i, d))


@pytest.mark.parametrize("gain", [0.05, 0.1, 0.3])
def test_a_position_motor_moves_a_part_p_of_the_error_in_each_step_of_the_engine(tmp_path: Path, gain: float) -> None:
    file = write(tmp_path / "arm.ttt", arm(0, 8, 0.02, gains(gain, 0, 0)))
    simulation = bubblesim.Simulation(str(file))
    simulation.step(1)  # ten steps of the engine, of 5 ms
    assert simulation.object("/Base/motor").joint_position == pytest.approx(0.02 * (1 - (1 - gain) ** 10), rel=0.01)


def test_gains_that_do_not_count_are_listed(tmp_path: Path) -> None:
    shown = program("describe", write(tmp_path / "arm.ttt", arm(0, 8, 0.02, gains(0.1, 0.01, 0)))).stdout
    assert "1 x position control with gains I or D: only P counts (motor)" in shown
    assert "gains" not in program("describe", write(tmp_path / "arm.ttt", arm(0, 8, 0.02, gains(0.1, 0, 0)))).stdout


ALL, TREE = 5, 1
SHOW = """sim=require'sim'
function sysCall_init()
  local names = {}
  for _, handle in ipairs(sim.getCollectionObjects(sim.getCollectionHandle('others'))) do
    names[#names+1] = sim.getObjectAlias(handle)
  end
  table.sort(names)
  print(table.concat(names, ' '))
  print(#sim.getCollectionObjects(sim.getCollectionHandle('unknown')))
end
"""


def test_scripts_find_saved_collections(tmp_path: Path) -> None:
    def element(what: int, handle: int, adds: int) -> bytes:
        fields = item("Obj", struct.pack("<2i", handle, 0)) + item("Gty", bytes([what])) + item("Var", bytes([adds]))
        return item("Asg", fields + b"EOO")

    elements = element(ALL, -1, 1) + element(TREE, 11, 0)  # all but the motor and what is below it
    saved = item("GRP", item("Grn", text("others")) + item("Gix", struct.pack("<i", 5000)) + elements + b"EOO")
    file = write(tmp_path / "arm.ttt", arm(0, 0, 0), BOX, FLOOR, saved, script(2, SHOW))
    run = run_sim(file, "--no-ros", "--speed", "max", "--until", "0.1", "--strict")
    assert run.returncode == 0, run.stderr
    assert "Base Box Floor\n" in run.stdout
    assert "\n0\n" in run.stdout


CORNERS = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
TRIANGLE = [(0, 2, 1)]  # seen from below
CORNER = [(0, 2, 1), (0, 1, 3)]  # such as the body round a lidar
TETRAHEDRON = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]


@pytest.mark.parametrize(
    ("triangles", "faces"),
    [(TRIANGLE, [(1, 3, 2), (1, 2, 3)]), (CORNER, [(1, 3, 2), (1, 2, 4)]), (TETRAHEDRON, None)],
    ids=["flat", "open", "closed"],
)
def test_flat_surfaces_are_seen_from_both_sides(
    tmp_path: Path, triangles: list[tuple[int, int, int]], faces: list[tuple[int, int, int]] | None
) -> None:
    file = write(tmp_path / "mesh.ttt", arrays((CORNERS, triangles)), thing("SHP", 1, -1, "Sheet", mesh(0)))
    run = program("convert", file, tmp_path / "made")
    assert run.returncode == 0, run.stderr
    lines = (tmp_path / "made" / "meshes" / "Sheet_visual.obj").read_text().splitlines()
    found = [tuple(int(number) for number in line.split()[1:]) for line in lines if line.startswith("f")]
    assert found == (faces or [tuple(vertex + 1 for vertex in triangle) for triangle in triangles])


REMOVES = """sim=require'sim'
function sysCall_init()
  sim.removeModel(sim.getObject('/Base'))
  print('left: '..tostring(sim.getObject('/Load', {noError = true}))..' '..#sim.getObjectsInTree(sim.handle_scene))
end
function sysCall_actuation() end
"""


def test_what_hangs_on_a_model_is_removed_with_it(tmp_path: Path) -> None:
    load = thing("SHP", 20, 12, "Load", cuboid((0.1, 0.1, 0.1), 1), (1, 0, 0, 0, 0.3, 0, 0.2))  # nothing connects it
    file = write(tmp_path / "arm.ttt", arm(0, 0, 0), load, FLOOR, BOX, script(2, REMOVES))
    run = run_sim(file, "--no-ros", "--speed", "max", "--until", "0.2", "--strict")
    assert run.returncode == 0, run.stderr
    assert "left: -1 2\n" in run.stdout  # the floor and the box


def test_a_part_of_a_robot_is_not_removed_on_its_own(tmp_path: Path) -> None:
    load = thing("SHP", 20, 12, "Load", cuboid((0.1, 0.1, 0.1), 1), (1, 0, 0, 0, 0.3, 0, 0.2))
    code = "function sysCall_init() sim.removeModel(sim.getObject('/Base/motor/Arm')) end"
    run = run_sim(
        write(tmp_path / "arm.ttt", arm(0, 0, 0), load, BOX, script(2, code)),
        "--no-ros",
        "--speed",
        "max",
        "--until",
        "0.1",
    )
    assert "/Arm cannot be removed on its own: it is connected with /Base" in run.stderr


@pytest.mark.parametrize(("mask", "pushes"), [(0xFF01, True), (0xFF02, False)], ids=["low half shared", "not shared"])
def test_bodies_of_one_robot_collide_by_the_low_half_of_their_masks(tmp_path: Path, mask: int, pushes: bool) -> None:
    """Two beams on one base: the first turns by its motor towards the other one, which turns freely."""

    def beam(handle: int, half: bytes, mask: int, place: tuple[float, ...]) -> bytes:
        own = cuboid((0.8, 0.05, 0.05), 1).replace(b"\xff\xff", struct.pack("<H", mask))
        motor = thing("JNT", handle, 10, f"motor{handle}", half)
        return motor + thing("SHP", handle + 1, handle, f"Beam{handle}", own, place)

    base = thing("SHP", 10, -1, "Base", cuboid((0.1, 0.1, 0.1)))
    turned = (math.sqrt(0.5), 0, 0, math.sqrt(0.5), 0, 0.6, 0)  # along y
    beams = beam(20, joint(0, 4, 1), 0xFF01, (1, 0, 0, 0, 0.6, 0, 0)) + beam(30, joint(0, 0, 0), mask, turned)
    simulation = bubblesim.Simulation(str(write(tmp_path / "beams.ttt", base, beams)))
    simulation.step(36)  # 1.8 s
    assert simulation.object("/Base/motor20").joint_position == pytest.approx(1.8, abs=0.05)
    pushed = simulation.object("/Base/motor30").joint_position
    assert pushed > 0.2 if pushes else pushed == pytest.approx(0, abs=1e-6)
