# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots and batches in Python."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import bubblesim
from bubblesim.gazebo_plugins.rate import Rate
from bubblesim.gazebo_plugins.saved_state import collected, restored

CONTINUED = """
import sys, bubblesim
simulation = bubblesim.Simulation("tricycle", seed=99)
simulation.restore(open(sys.argv[1], "rb").read())
simulation.step(20)
print(simulation.state_hash())
"""


def driving() -> bubblesim.Simulation:
    simulation = bubblesim.Simulation("tricycle", seed=3)
    simulation.object("/FrontMotor").target_velocity = 3.0
    simulation.object("/Steering").target_position = 0.3
    simulation.step(15)
    return simulation


def test_another_process_continues_a_saved_state(tmp_path: Path) -> None:
    simulation = driving()
    file = tmp_path / "state"
    file.write_bytes(simulation.save())
    simulation.step(20)
    run = subprocess.run([sys.executable, "-c", CONTINUED, str(file)], capture_output=True, text=True, check=True)
    assert int(run.stdout) == simulation.state_hash()


def test_bytes_that_are_no_state_are_refused() -> None:
    simulation = driving()
    before = simulation.state_hash()
    with pytest.raises(ValueError, match="damaged"):
        simulation.restore(simulation.save()[:-1])
    with pytest.raises(ValueError, match="another scene"):
        simulation.restore(bubblesim.Simulation("ball").save())
    assert simulation.state_hash() == before


def test_a_refused_state_leaves_the_models_that_were_added() -> None:
    simulation = driving()
    saved = simulation.save()
    other = bubblesim.Simulation("tricycle")
    other.add_model("<sdf version='1.9'><model name='Added'><link name='link'/></model></sdf>", position=[0, 0, 3])
    other.step(3)
    before = other.save()
    for size in range(0, len(saved), 101):
        with pytest.raises(ValueError, match="state"):
            other.restore(saved[:size])
    assert other.save() == before
    assert other.object("/Added").position[2] > 0
    other.restore(saved)
    assert other.state_hash() == simulation.state_hash()


class Generator:
    """Has what a plugin may have."""

    def __init__(self, simulation: bubblesim.Simulation) -> None:
        self.simulation = simulation
        self.rate = Rate(10.0, simulation)
        self.random = np.random.default_rng(1)
        self.commands = {"left": [1.0, float("inf")], "right": (None, "text")}
        self.matrix = np.eye(2)
        self.function = driving


Generator.__module__ = "bubblesim.gazebo_plugins.test"


def test_plugins_get_back_the_values_of_their_attributes() -> None:
    simulation = bubblesim.Simulation("ball")
    plugin = Generator(simulation)
    plugin.random.normal()
    saved = collected(plugin)
    expected = plugin.random.normal()
    rate = plugin.rate
    simulation.step(3)
    assert plugin.rate.due()
    plugin.commands = {}
    plugin.matrix = np.zeros(2)
    restored(saved, plugin)
    assert plugin.random.normal() == expected
    assert plugin.rate is rate
    assert plugin.rate.due()
    assert plugin.commands == {"left": [1.0, float("inf")], "right": (None, "text")}
    assert plugin.matrix.tolist() == [[1, 0], [0, 1]]
    assert plugin.simulation is simulation


def test_a_batch_equals_its_simulations() -> None:
    batch = bubblesim.Batch(
        "tricycle",
        5,
        seed=3,
        threads=2,
        actions=["/FrontMotor.target_velocity", "/Steering.target_position"],
        observations=["/Tricycle.pose", "/FrontSonar.distance"],
        dtype="float64",
    )
    actions = np.tile([3.0, 0.3], (5, 1))
    for _ in range(15):
        observed = batch.step(actions)
    assert batch[0].state_hash() == driving().state_hash()
    assert observed.flags.c_contiguous
    assert observed[0, :3].tolist() == driving().object("/Tricycle").position.tolist()
    assert [quantity.columns for quantity in batch.observations] == [slice(0, 7, 1), slice(7, 8, 1)]
    assert not batch.failed.any()


def test_a_batch_resets_marked_worlds() -> None:
    batch = bubblesim.Batch("tricycle", 3, observations=["time"])
    batch.step(steps=4)
    state = batch[2].save()
    assert batch.reset(mask=np.array([True, False, True]))[:, 0] == pytest.approx([0, 0.2, 0])
    assert batch.reset(seeds=np.arange(3) + 10).max() == 0
    assert [world.seed for world in batch] == [10, 11, 12]
    assert batch.reset(state=state)[:, 0] == pytest.approx([0.2, 0.2, 0.2])


def test_a_batch_refuses_actions_of_another_shape() -> None:
    batch = bubblesim.Batch("tricycle", 3, actions=["/FrontMotor.target_velocity"])
    with pytest.raises(ValueError, match="3 x 1"):
        batch.step(np.zeros((1, 3)))
    with pytest.raises(ValueError, match="there are pose"):
        bubblesim.Batch("tricycle", 1, observations=["/Tricycle.speed"])
    with pytest.raises(IndexError):
        batch[3]
