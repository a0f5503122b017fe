# SPDX-License-Identifier: BSD-3-Clause
"""Messages about plugins that cannot work as written."""

from pathlib import Path

import pytest

from cli_support import bubblesim as command
from node_support import Node, run_sim, write
from ros_support import RosCore

MODEL = """\
<sdf version="1.9">
  <model name="robot">
    <link name="body">
      <inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>
      <collision name="ball"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
    </link>
    <link name="wheel"><pose>0 0.2 0 0 0 0</pose></link>
    <joint name="wheel_joint" type="revolute">
      <parent>body</parent><child>wheel</child><axis><xyz>0 1 0</xyz></axis></joint>
    {plugin}
  </model>
</sdf>
"""


@pytest.mark.parametrize(
    ("plugin", "reported"),
    [
        (
            '<plugin name="arm" filename="libmy_arm.so"/>',
            "warning: {file}:10: plugin 'arm' (libmy_arm.so): plugin is not supported; the model runs without it",
        ),
        (
            '<plugin name="drive" filename="libgazebo_ros_dif_drive.so"/>',
            "plugin is not supported; did you mean gazebo_ros_diff_drive?; the model runs without it",
        ),
        (
            '<plugin name="control" filename="libgazebo_ros_control.so"/>',
            "warning: {file}:10: plugin 'control' (libgazebo_ros_control.so): the model has no <transmission>",
        ),
        (
            '<plugin name="joints" filename="libgazebo_ros_joint_state_publisher.so">\n'
            "<jointName>weel_joint</jointName></plugin>",
            "error: {file}:11: plugin 'joints': <jointName> is 'weel_joint', which is not a joint of /robot; did you "
            "mean wheel_joint?",
        ),
        (
            '<plugin name="joints" filename="libgazebo_ros_joint_state_publisher.so">\n'
            "<updateRate>often</updateRate></plugin>",
            "error: {file}:11: plugin 'joints': <updateRate> is 'often', it must be a number of at least 0",
        ),
        (
            '<plugin name="joints" filename="libgazebo_ros_joint_state_publisher.so">\n'
            "<updateRat>5</updateRat></plugin>",
            "warning: {file}:10: plugin 'joints' (libgazebo_ros_joint_state_publisher.so) has unknown parameters: "
            "updateRat; did you mean update_rate?",
        ),
    ],
)
def test_the_file_and_line_are_reported_once_and_the_model_runs_on(
    shared_core: RosCore, tmp_path: Path, plugin: str, reported: str
) -> None:
    file = write(tmp_path / "robot.sdf", MODEL.replace("{plugin}", plugin))
    with Node(shared_core.env, tmp_path / "log", file, "--until", "0.5", "--speed", "max") as node:
        assert node.process.wait(60) == 0
    assert node.output.count(reported.format(file=file)) == 1, node.output


def test_plugins_without_a_device_are_reported_without_ros_too(tmp_path: Path) -> None:
    plugins = (
        '<plugin name="arm" filename="libmy_arm.so"/><plugin name="drive" filename="libgazebo_ros_diff_drive.so"/>'
    )
    file = write(tmp_path / "robot.sdf", MODEL.format(plugin=plugins))
    reported = f"warning: {file}:10: plugin 'arm' (libmy_arm.so): plugin is not supported; the model runs without it"
    run = run_sim(file, "--no-ros", "--until", "0.1", "--speed", "max")
    assert (run.returncode, run.stderr.splitlines()) == (0, [reported])
    assert command("check", file).stderr.splitlines() == [reported]
