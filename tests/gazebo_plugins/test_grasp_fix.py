# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_grasp_plugin's parameters; when it attaches and releases is tested in tests/sim/devices/test_grasp.cpp."""

from pathlib import Path

import pytest

import bubblesim
from bubblesim.gazebo_plugins.robots import GazeboPlugins

ARM = "<palm_link>palm</palm_link><gripper_link>left</gripper_link><gripper_link>right</gripper_link>"
MOTOR = "<bubblesim:motor>{}</bubblesim:motor>"


def part(name: str, y: float, axis: str, motor: str) -> str:
    shape = '<collision name="pad"><geometry><box><size>0.1 0.02 0.2</size></box></geometry></collision>'
    mass = "<inertial><mass>.2</mass><inertia><ixx>.001</ixx><iyy>.001</iyy><izz>.001</izz></inertia></inertial>"
    return (
        f'<link name="{name}"><pose>0 {y} 0.1 0 0 0</pose>{mass}{shape}</link>'
        f'<joint name="close_{name}" type="prismatic"><parent>palm</parent><child>{name}</child>'
        f"<axis><xyz>{axis}</xyz><limit><effort>20</effort></limit>{motor}</axis></joint>"
    )


def world(parameters: str) -> str:
    lift = (
        '<joint name="lift" type="prismatic"><parent>world</parent><child>palm</child><axis><xyz>0 0 1</xyz>'
        f"{MOTOR.format('position')}</axis></joint>"
    )
    velocity = MOTOR.format("velocity")
    hand = (
        '<link name="palm"><pose>0 0 0.5 0 0 0</pose></link>'
        f"{lift}{part('left', 0.1, '0 -1 0', velocity)}{part('right', -0.1, '0 1 0', velocity)}"
    )
    slippery = "<surface><friction><ode><mu>0.01</mu></ode></friction></surface>"
    box = (
        '<model name="box"><pose>0 0 0.05 0 0 0</pose><link name="body"><inertial><mass>.5</mass><inertia>'
        "<ixx>.001</ixx><iyy>.001</iyy><izz>.001</izz></inertia></inertial>"
        '<collision name="c"><geometry><box><size>.1 .1 .1</size></box></geometry>'
        f"{slippery}</collision></link></model>"
    )
    ground = (
        '<model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry>'
        "</collision></link></model>"
    )
    plugin = f'<plugin name="grasp" filename="libgazebo_grasp_fix.so">{parameters}</plugin>'
    models = f'{ground}{box}<model name="hand">{hand}{plugin}</model>'
    return f'<sdf version="1.9" xmlns:bubblesim="https://bubblesim"><world name="w">{models}</world></sdf>'


def simulate(folder: Path, parameters: str) -> bubblesim.Simulation:
    (folder / "w.sdf").write_text(world(parameters))
    simulation = bubblesim.Simulation(str(folder / "w.sdf"))
    GazeboPlugins(simulation, None)
    return simulation


def close(simulation: bubblesim.Simulation, speed: float, steps: int) -> None:
    for name in ("left", "right"):
        simulation.object(f"/hand/close_{name}").target_velocity = speed
    simulation.step(steps)


@pytest.mark.parametrize("arm", [f"<arm><arm_name>a</arm_name>{ARM}</arm>", ARM])
def test_it_lifts_a_slippery_box(tmp_path: Path, arm: str) -> None:
    simulation = simulate(tmp_path, f"{arm}<update_rate>20</update_rate><grip_count_threshold>4</grip_count_threshold>")
    close(simulation, 0.1, 30)
    assert len(simulation.world.attachments) == 1
    simulation.object("/hand/lift").target_position = 0.3
    simulation.step(20)
    assert float(simulation.object("/box").position[2]) == pytest.approx(0.35, abs=0.01)
    close(simulation, -0.1, 30)
    assert not simulation.world.attachments


def test_an_update_rate_makes_it_wait(tmp_path: Path) -> None:
    simulation = simulate(tmp_path, f"{ARM}<update_rate>1</update_rate><grip_count_threshold>2</grip_count_threshold>")
    close(simulation, 0.1, 50)  # 2.5 s: two updates at most
    assert not simulation.world.attachments
    close(simulation, 0.1, 40)
    assert len(simulation.world.attachments) == 1


def test_links_that_are_missing_are_named(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    simulate(tmp_path, ARM.replace(">left<", ">lefd<"))
    assert "<gripper_link> is 'lefd', which is not a link of /hand; did you mean left?" in capfd.readouterr().err
