# SPDX-License-Identifier: BSD-3-Clause
"""Drawing objects of scripts: the items that viewers get."""

import math
from pathlib import Path

import numpy as np
import pytest

from bubblesim.scene_state.drawings import Drawings, Style
from node_support import in_init, run_script

HEADER = """
import math
import numpy as np
near = lambda a, b, tol=1e-6: np.testing.assert_allclose(a, b, atol=tol)
def refused(call, *arguments):
    try:
        call(*arguments)
    except (ValueError, TypeError, LookupError) as error:
        return str(error)
    raise AssertionError('accepted')
def shown(handle, since=0):
    found = [each for each in sim.getDrawings(since)['changed'] if each['handle'] == handle]
    return found[0] if found else None
def items(handle, since=0):
    found = shown(handle, since)
    return np.frombuffer(found['items'], np.float32).reshape(-1, found['values'])
"""


def check(folder: Path, body: str, rest: str = "") -> str:
    """Run `body` in sysCall_init of the tricycle; an error fails the test. Return what it printed."""
    run = run_script(folder, f"{HEADER}{in_init(body)}{rest}", "--strict", scene="tricycle", target="/Tricycle")
    assert (run.stderr, run.returncode) == ("", 0)
    return run.stdout


def test_items_have_coordinates_colours_sizes_and_transparencies(tmp_path: Path) -> None:
    body = """
dots = sim.addDrawingObject(sim.drawing_points, 3, 0, -1, 10, [1, 0, 0])
assert sim.addDrawingObjectItem(dots, [1, 2, 3]) == 1
near(items(dots), [[1, 2, 3]])
assert shown(dots)['kind'] == 'points' and shown(dots)['colour'] == [1, 0, 0] and shown(dots)['size'] == 3
kind = sim.drawing_spherepts | sim.drawing_itemcolors | sim.drawing_itemsizes | sim.drawing_itemtransparency
balls = sim.addDrawingObject(kind, 0.1, 0, -1, 10)
sim.addDrawingObjectItem(balls, [1, 2, 3, 0.1, 0.2, 0.3, 0.5, 0.25])
near(items(balls), [[1, 2, 3, 0.1, 0.2, 0.3, 0.5, 0.25]])
lines = sim.addDrawingObject(sim.drawing_lines + sim.drawing_vertexcolors, 2, 0, -1, 10)
sim.addDrawingObjectItem(lines, [0, 0, 0, 1, 1, 1] + [1, 0, 0] + [0, 0, 1])
assert items(lines).shape == (1, 12)
faint = sim.addDrawingObject(sim.drawing_triangles + sim.drawing_50percenttransparency, 1, 0, -1, 1)
assert shown(faint)['opacity'] == 0.5
sim.addDrawingObjectItem(faint, [0, 0, 0, 1, 0, 0, 0, 1, 0])
"""
    check(tmp_path, body)


def test_normals_of_older_scripts_become_rotations(tmp_path: Path) -> None:
    body = """
disc = sim.addDrawingObject(sim.drawing_discpoints + sim.drawing_itemsizes, 0.2, 0, -1, 9)
for normal in ([0, 0, 1], [1, 0, 0], [0, -2, 0], [0, 0, -1], [1, 1, 1]):
    sim.addDrawingObjectItem(disc, [5, 6, 7, *normal, 0.4])
    row = items(disc)[-1]
    axis = sim.multiplyVector(row[:7].tolist(), [0, 0, 1]) - row[:3]
    near(axis, np.array(normal) / np.linalg.norm(normal))
    near(row[7], 0.4)
new = sim.addDrawingObject(sim.drawing_discpts, 0.2, 0, -1, 9)
sim.addDrawingObjectItem(new, [1, 2, 3, 0, 0, 0, 1])
near(items(new), [[1, 2, 3, 0, 0, 0, 1]])
"""
    check(tmp_path, body)


def test_items_are_kept_in_the_frame_of_the_object_that_they_move_with(tmp_path: Path) -> None:
    body = """
car = sim.getObject('/Tricycle')
sim.setObjectPosition(car, [1, 2, 0.5])
sim.setObjectOrientation(car, [0, 0, math.pi / 2])
strip = sim.addDrawingObject(sim.drawing_linestrip, 2, 0, car, 100)
sim.addDrawingObjectItem(strip, [1, 3, 0.5])
near(items(strip), [[1, 0, 0]])
local = sim.addDrawingObject(sim.drawing_cubepts + sim.drawing_local, 0.1, 0, car, 100)
sim.addDrawingObjectItem(local, [1, 0, 0, 0, 0, 0, 1])
near(items(local), [[1, 0, 0, 0, 0, 0, 1]])
poses = sim.getDrawings()['poses']
near(poses[str(car)], sim.getObjectPose(car))
assert shown(strip)['parent'] == car
"""
    check(tmp_path, body)


def test_a_full_drawing_refuses_items_or_drops_the_oldest(tmp_path: Path) -> None:
    body = """
some = sim.addDrawingObject(sim.drawing_points, 1, 0, -1, 2)
assert [sim.addDrawingObjectItem(some, [n, 0, 0]) for n in range(3)] == [1, 1, 0]
near(items(some)[:, 0], [0, 1])
last = sim.addDrawingObject(sim.drawing_points + sim.drawing_cyclic, 1, 0, -1, 3)
for n in range(100):
    assert sim.addDrawingObjectItem(last, [n, 0, 0]) == 1
near(items(last)[:, 0], [97, 98, 99])
assert (shown(last)['first'], shown(last)['start']) == (97, 97)
apart = sim.addDrawingObject(sim.drawing_points, 1, 0.5, -1, 100)
assert [sim.addDrawingObjectItem(apart, [0.2 * n, 0, 0]) for n in range(6)] == [1, 0, 0, 1, 0, 0]
near(items(apart)[:, 0], [0, 0.6])
"""
    check(tmp_path, body)


def test_readers_get_what_is_new_since_a_revision(tmp_path: Path) -> None:
    body = """
dots = sim.addDrawingObject(sim.drawing_points + sim.drawing_cyclic, 1, 0, -1, 5)
other = sim.addDrawingObject(sim.drawing_points, 1, 0, -1, 5)
for n in range(4):
    sim.addDrawingObjectItem(dots, [n, 0, 0])
seen = sim.getDrawings()['revision']
assert sim.getDrawings(seen)['changed'] == [] and sim.getDrawings(seen)['handles'] == [dots, other]
for n in range(4, 7):
    sim.addDrawingObjectItem(dots, [n, 0, 0])
now = sim.getDrawings(seen)
assert [each['handle'] for each in now['changed']] == [dots] and now['revision'] > seen
near(items(dots, seen)[:, 0], [4, 5, 6])
assert (shown(dots, seen)['first'], shown(dots, seen)['start']) == (2, 4)
sim.addDrawingObjectItem(dots, None)
assert len(items(dots, now['revision'])) == 0 and shown(dots)['first'] == 7
sim.removeDrawingObject(other)
assert sim.getDrawings()['handles'] == [dots]
assert len(sim.getDrawings(10 ** 9)['changed']) == 1
sim.removeDrawingObject(sim.handle_all)
assert sim.getDrawings()['handles'] == []
"""
    check(tmp_path, body)


def test_several_items_are_added_at_once(tmp_path: Path) -> None:
    body = """
dots = sim.addDrawingObject(sim.drawing_points, 1, 0, -1, 5)
assert sim.addDrawingObjectItem(dots | sim.handleflag_addmultiple, [1, 0, 0, 2, 0, 0]) == 1
near(items(dots)[:, 0], [1, 2])
"""
    check(tmp_path, body)


def test_surplus_numbers_of_an_item_are_left_out(tmp_path: Path) -> None:
    body = """
dots = sim.addDrawingObject(sim.drawing_points, 1, 0, -1, 5)
assert sim.addDrawingObjectItem(dots, [1, 0, 0, 2, 0, 0]) == 1
near(items(dots)[:, 0], [1])
"""
    check(tmp_path, body)


def test_bad_arguments_are_refused(tmp_path: Path) -> None:
    body = """
dots = sim.addDrawingObject(sim.drawing_points, 1, 0, -1, 5)
assert 'an item of this drawing has 3 numbers, found 2' in refused(sim.addDrawingObjectItem, dots, [1, 2])
assert 'must be finite' in refused(sim.addDrawingObjectItem, dots, [1, 2, math.nan])
assert '99 is not the handle of a drawing object' in refused(sim.addDrawingObjectItem, 99, [1, 2, 3])
assert 'not a type of drawing' in refused(sim.addDrawingObject, 31, 1)
assert '12345' in refused(sim.addDrawingObject, 0, 1, 0, 12345)
assert 'a colour has three numbers' in refused(sim.addDrawingObject, 0, 1, 0, -1, 5, [1])
"""
    check(tmp_path, body)


def test_a_script_in_lua_draws(tmp_path: Path) -> None:
    code = """
function sysCall_init()
    local kind = sim.drawing_spherepts | sim.drawing_itemcolors
    local d = sim.addDrawingObject(kind, 0.05, 0, -1, 100, nil, nil, nil, {1, 0, 0})
    assert(sim.addDrawingObjectItem(d, {1, 2, 3, 0, 1, 0}) == 1)
    local found = sim.getDrawings().changed[1]
    assert(found.kind == 'sphere' and #found.items == 24 and found.emission[1] == 1)
    sim.addDrawingObjectItem(d, nil)
    assert(#sim.getDrawings().changed[1].items == 0)
end
"""
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert (run.stderr, run.returncode) == ("", 0)


@pytest.mark.parametrize("ending", ["raise ValueError('enough')", "sys.exit()"])
def test_drawings_end_with_their_script(tmp_path: Path, ending: str) -> None:
    ball = tmp_path / "ball.py"
    ball.write_text(
        "import sys\n"
        "def sysCall_init(): sim.addDrawingObject(sim.drawing_points, 1)\n"
        f"def sysCall_actuation():\n    if sim.getSimulationTime() > 0.07: {ending}\n"
    )
    code = "def sysCall_init(): pass\ndef sysCall_sensing(): print(len(sim.getDrawings()['handles']))\n"
    run = run_script(tmp_path, code, "--child-script", f"/Ball={ball}", scene="ball", target="/Ball/link")
    assert run.stdout.split() == ["1", "1", "0", "0"]


def test_an_item_near_another_one_is_found_wherever_it_is() -> None:
    random = np.random.default_rng(1)
    drawings = Drawings()
    drawing = drawings.create(0, Style("points", cyclic=True), capacity=200, tolerance=0.1)
    kept: list[list[float]] = []
    for place in random.uniform(-0.5, 0.5, (3000, 3)).tolist():
        is_near = any(math.dist(place, other) < 0.1 for other in kept)
        assert drawings.add_item(drawing.handle, place) is not is_near
        kept = kept if is_near else [*kept, place][-200:]
    np.testing.assert_allclose(drawing.items(), kept, atol=1e-6)


def test_the_numbers_of_all_drawings_have_a_limit() -> None:
    drawings = Drawings()
    style = Style("triangles", colours=9, has_sizes=True, has_transparencies=True)
    full, other = (drawings.create(0, style, capacity=1_000_000).handle for _ in range(2))
    for _ in range(500_000):
        drawings.add_item(full, [0.0] * 20)
    with pytest.raises(ValueError, match="at most 10000000 numbers: remove some items"):
        drawings.add_item(other, [0.0] * 20)
    drawings.clear_items(full)
    assert drawings.add_item(other, [0.0] * 20)
