# SPDX-License-Identifier: BSD-3-Clause
"""Mass, friction, gravity and randomization in Python and in scenes."""

from pathlib import Path

import numpy as np
import pytest

import bubblesim
from bubblesim import Distribution

SCENE = """<sdf version="1.9" xmlns:bubblesim="https://bubblesim"><world name="w">
<bubblesim:randomize quantity="/Box.mass" low="1" high="3"/>
<bubblesim:randomize quantity="/Box.position" distribution="normal" mean="0" standard_deviation="0.1 0.1 0"
  operation="add"/>
<bubblesim:randomize quantity="{choice}" distribution="choice" values="0.2 0.4"/>
<model name="Box"><pose>1 2 3 0 0 0</pose><link name="link">
<collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision></link></model>
</world></sdf>"""


def scene(folder: Path, choice: str = "/Box.friction") -> str:
    file = folder / "random.sdf"
    file.write_text(SCENE.format(choice=choice))
    return str(file)


def test_properties_of_objects_can_be_set() -> None:
    simulation = bubblesim.Simulation("tricycle")
    robot, gravity = simulation.object("/Tricycle"), simulation.world.gravity
    mass = robot.mass
    robot.mass = 2 * mass
    robot.friction = 0.3
    simulation.world.set_gravity([0, 0, -1])
    state = simulation.save()
    assert simulation.object("/base_link").friction == 0.3
    simulation.reset()
    assert (robot.mass, simulation.world.gravity) == (mass, gravity)
    simulation.restore(state)
    assert (robot.mass, robot.friction, simulation.world.gravity[2]) == (2 * mass, 0.3, -1)
    with pytest.raises(ValueError, match="/Tricycle: the mass -1 kg is not usable"):
        robot.mass = -1
    with pytest.raises(bubblesim.WrongObject, match="has no mass"):
        _ = simulation.object("/FrontSonar").mass


def test_a_scene_is_drawn_by_the_seed(tmp_path: Path) -> None:
    file = scene(tmp_path)
    boxes = [bubblesim.Simulation(file, seed=seed).object("/Box") for seed in range(50)]
    masses = [box.mass for box in boxes]
    assert len(set(masses)) == 50
    assert min(masses) >= 1
    assert max(masses) <= 3
    assert {box.friction for box in boxes} == {0.2, 0.4}
    positions = np.array([box.position for box in boxes])
    assert np.abs(positions[:, :2].mean(axis=0) - [1, 2]).max() < 4 * 0.1 / np.sqrt(50)
    assert (positions[:, 2] == 3).all()
    assert (
        bubblesim.Batch(file, 8, seed=4)[7].object("/Box").mass
        == bubblesim.Simulation(file, seed=11).object("/Box").mass
    )


def test_errors_of_a_scene_have_their_line(tmp_path: Path) -> None:
    file = scene(tmp_path, "/Bax.friction")
    with pytest.raises(bubblesim.SceneError, match=r"random.sdf:5: randomize /Bax.friction: .*Bax"):
        bubblesim.Simulation(file)


def test_a_batch_is_randomized() -> None:
    randomize = {
        "/Tricycle.mass": Distribution.uniform(0.5, 2.0, operation="scale"),
        "/Tricycle.position": Distribution.choice([[0, 0, 0], [1, 1, 0]]),
        "gravity": Distribution.normal(0, [0, 0, 0.1], operation="add"),
    }
    batch = bubblesim.Batch("tricycle", 6, seed=5, observations=["/Tricycle.mass", "gravity"], randomize=randomize)
    first = batch.observe().copy()
    assert len(set(first[:, 0])) == 6
    assert (batch.reset() == first).all()
    alone = bubblesim.Simulation("tricycle", seed=100)
    alone.randomize(randomize)
    batch.reset(seeds=np.full(6, 100))
    batch.step(steps=5)
    alone.step(5)
    assert {batch[i].state_hash() for i in range(6)} == {alone.state_hash()}


def test_bad_distributions_are_refused() -> None:
    simulation = bubblesim.Simulation("tricycle")
    with pytest.raises(ValueError, match="operation 'multiply' is not usable"):
        Distribution.uniform(1, 2, operation="multiply")
    with pytest.raises(ValueError, match=r"randomize /Tricycle.mass: low is 2"):
        simulation.randomize({"/Tricycle.mass": Distribution.uniform(2, 1)})
    with pytest.raises(TypeError, match="expected Distributions by quantity"):
        simulation.randomize({"/Tricycle.mass": 2})
    with pytest.raises(ValueError, match="rows of 3 numbers"):
        bubblesim.Batch("tricycle", 2, randomize={"/Tricycle.position": Distribution.choice([1, 2])})
