# SPDX-License-Identifier: BSD-3-Clause
"""The <state> of a saved world: the initial poses of its models and links."""

import math
from pathlib import Path

import pytest

import bubblesim

WORLD = """\
<sdf version="1.6">
<world name="w">
<gravity>0 0 0</gravity>
<model name="barrier"><static>1</static><pose>1 0 0 0 0 0</pose><link name="l"/></model>
<model name="arm"><pose>5 0 0 0 0 0</pose>
<link name="base"/>
<link name="beam"><pose>0 0 1 0 0 0</pose></link>
<joint name="hinge" type="revolute"><parent>base</parent><child>beam</child><axis><xyz>0 0 1</xyz></axis></joint>
</model>
<light name="lamp" type="point"><pose>0 0 3 0 0 0</pose></light>
<state world_name="w"><sim_time>12 0</sim_time>
<model name="barrier"><pose>1 17 0 0 0 1.5</pose><link name="l"><pose>1 17 0 0 0 1.5</pose></link></model>
<model name="arm"><pose>6 0 0 0 0 1</pose>
<link name="base"><pose>6 0 0 0 0 1</pose></link>
<link name="beam"><pose>6 0 1 0 0 1.7</pose></link>
</model>
<model name="gone"><pose>0 0 0 0 0 0</pose></model>
</state>
</world></sdf>
"""


def test_models_links_and_joints_begin_as_they_were_saved(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "saved.world"
    file.write_text(WORLD)
    simulation = bubblesim.Simulation(str(file))
    objects = {each.path: each for each in simulation.objects}

    def check() -> None:
        assert objects["/barrier"].position == pytest.approx([1, 17, 0])
        assert objects["/arm"].position == pytest.approx([6, 0, 0])
        assert objects["/arm/beam"].position == pytest.approx([6, 0, 1], abs=1e-9)
        assert objects["/arm/beam"].orientation == pytest.approx([0, 0, math.sin(0.85), math.cos(0.85)])
        assert objects["/arm/hinge"].joint_position == pytest.approx(0.7)

    check()
    assert simulation.time == 0
    simulation.step(3)
    check()
    simulation.reset_world()
    check()
    warnings = capfd.readouterr().err.splitlines()
    assert warnings == [f"warning: {file}:17: /gone: the <state> contains this model, which is not in the world"]
