# SPDX-License-Identifier: BSD-3-Clause
"""The program check, which reports problems of scenes and models."""

import subprocess
from pathlib import Path

import pytest

from bubblesim.scene_files.check import main, problems_of
from ros_support import REPOSITORY

BAD = """\
<sdf version="1.9">
  <model name="Crate">
    <link name="link">
      <collision name="box"><geometry><box><size>0.4 -0.4 0.4</size></box></geometry></collision>
      <collision name="mesh"><geometry><mesh><uri>nowhere.stl</uri></mesh></geometry></collision>
    </link>
    <joint name="joint" type="fixed"><parent>world</parent><child>lnik</child></joint>
  </model>
</sdf>
"""


def written(folder: Path, text: str) -> str:
    file = folder / "scene.sdf"
    file.write_text(text)
    return str(file)


def test_all_that_is_wrong_is_reported_with_its_line(tmp_path: Path) -> None:
    file = written(tmp_path, BAD.replace("lnik", "link"))
    start = f"{file}:4: /Crate/link/box: the box's y size is -0.4 m"
    assert any(problem.startswith(start) for problem in problems_of(file))


def test_shipped_scenes_are_fine(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["ball", str(REPOSITORY / "scenes" / "models" / "ground_plane" / "model.sdf")]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "ball: fine"
    assert len(lines) == 2


def test_a_problem_ends_with_two_after_all_files_were_looked_at(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = written(tmp_path, BAD)
    assert main([file, "bal", "ball"]) == 2
    lines = capsys.readouterr().out.splitlines()
    assert any(line.startswith(f"{file}:4:") for line in lines)
    assert any("did you mean ball" in line for line in lines)
    assert lines[-1] == "ball: fine"


@pytest.mark.parametrize(("lines", "summary"), [(1, "1 warning"), (2, "2 warnings")])
def test_warnings_are_counted(tmp_path: Path, capfd: pytest.CaptureFixture[str], lines: int, summary: str) -> None:
    unknown = ['<plugin name="p" filename="libunheard_of.so"/>', "<unknown_element/>"][:lines]
    file = written(tmp_path, BAD.split("<collision")[0] + f"</link>{' '.join(unknown)}</model></sdf>")
    assert main([file]) == 0
    output, warnings = capfd.readouterr()
    assert output == f"{file}: {summary}\n"
    assert warnings.count("warning: ") == lines


def test_a_model_that_falls_out_of_the_scene_is_a_warning(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    falling = '<model name="stone"><pose>0 0 -998 0 0 0</pose><link name="link"/></model>'
    file = written(tmp_path, f'<sdf version="1.9"><world name="w"><gravity>0 0 -9000</gravity>{falling}</world></sdf>')
    assert main([file]) == 0
    output, warnings = capfd.readouterr()
    assert "/stone fell below the scene" in warnings
    assert output == f"{file}: {warnings.count('warning: ')} warning\n"


def test_the_program_runs() -> None:
    program = REPOSITORY / "scripts" / "check"
    run = subprocess.run(["python3", program, "ball"], capture_output=True, text=True, check=True)
    assert run.stdout == "ball: fine\n"


TURNED = """\
<sdf version="1.9">
  <model name="Crate">
    <link name="link">
      <pose{attributes}>0 0 {radius} 0 0 90</pose>
      <inertial><mass>2</mass></inertial>
      <collision name="ball"><geometry><sphere><radius>{radius}</radius></sphere></geometry></collision>
    </link>
  </model>
</sdf>
"""


def test_an_angle_of_more_than_a_turn_is_asked_about(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    file = written(tmp_path, TURNED.format(attributes="", radius=0.2))
    assert main([file]) == 0
    output, warnings = capfd.readouterr()
    assert warnings == (
        f"warning: {file}:4: <pose> has a yaw of 90 rad, more than a turn; 90 degrees are 1.5708\n"  # pi / 2
    )
    assert output == f"{file}: 1 warning\n"
    for attributes in (' degrees="true"', ' rotation_format="quat_xyzw"'):
        text = TURNED.format(attributes=attributes, radius=0.2)
        assert main([written(tmp_path, text.replace("0 0 90", "0 0 0 1") if "quat" in text else text)]) == 0
        assert capfd.readouterr().err == ""


def test_an_angle_of_a_urdf_file_is_asked_about(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    robot = tmp_path / "robot.urdf"
    robot.write_text(
        '<robot name="r"><link name="a"/><link name="b"/>\n<joint name="j" type="fixed"><parent link="a"/>'
        '<child link="b"/>\n<origin xyz="0 0 1" rpy="45 0 0"/></joint></robot>\n'
    )
    main([str(robot)])
    assert f"warning: {robot}:3: rpy of <origin> has a roll of 45 rad" in capfd.readouterr().err


@pytest.mark.parametrize(("radius", "asked"), [(150.0, True), (5.0, False)])
def test_a_large_model_almost_without_mass_is_asked_about(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], radius: float, asked: bool
) -> None:
    main([written(tmp_path, TURNED.format(attributes=' degrees="true"', radius=radius))])
    warned = "/Crate: it is about 300 m large and has a mass of 2 kg; lengths are in metres" in capfd.readouterr().err
    assert warned is asked


SENSOR = """\
<sdf version="1.9" xmlns:bubblesim="https://bubblesim">
  <model name="Post">
    <static>true</static>
    <link name="base">
      <sensor name="eye" type="{kind}"><bubblesim:topic>/eye</bubblesim:topic>{more}</sensor>
    </link>
  </model>
</sdf>
"""
FRAME = "<bubblesim:frame>eye</bubblesim:frame>"


@pytest.mark.parametrize(
    ("kind", "more", "why"),
    [
        ("imu", "<pose>0 0.3 0.4 0 0 0</pose>", "the sensor is 0.5 m from it"),  # 3, 4, 5
        ("imu", "<pose>0 0 0 0 0 1.5</pose>", "the sensor is turned by 1.5 rad"),
        ("imu", f"<pose>0 0.3 0.4 0 0 0</pose>{FRAME}", ""),
        ("imu", "", ""),
        ("camera", "", "images have an optical frame, z forward (REP 103)"),
        ("camera", FRAME, ""),
    ],
)
def test_a_frame_in_which_a_sensor_does_not_measure_is_warned_of(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], kind: str, more: str, why: str
) -> None:
    assert main([written(tmp_path, SENSOR.format(kind=kind, more=more))]) == 0
    cure = "<bubblesim:frame>eye</bubblesim:frame> gives it a frame of its own"
    line = f"warning: /Post/base/eye: /eye is in the frame base, but {why}: {cure}\n"
    assert capfd.readouterr().err == (line if why else "")


def test_a_topic_with_a_space_is_a_problem(tmp_path: Path) -> None:
    file = written(tmp_path, SENSOR.format(kind="imu", more="").replace("/eye<", "/my eye<"))
    assert problems_of(file) == [
        "/Post/base/eye: <bubblesim:topic>: invalid topic name '/my eye': it has ' '; use letters, digits, _ and /"
    ]


def test_joints_of_a_plugin_that_the_model_does_not_have_are_a_problem(tmp_path: Path) -> None:
    wheels = "".join(
        f'<link name="{side}"/><joint name="{side}_wheel" type="continuous"><parent>base</parent>'
        f"<child>{side}</child><axis><xyz>0 1 0</xyz></axis></joint>"
        for side in ("left", "right")
    )
    plugin = (
        '\n<plugin name="drive" filename="libgazebo_ros_diff_drive.so"><legacyMode>false</legacyMode>\n'
        "<leftJoint>left_whel</leftJoint><rightJoint>right_wheel</rightJoint></plugin>"
    )
    model = f'<sdf version="1.9"><model name="Robot"><link name="base"/>{wheels}{plugin}</model></sdf>'
    file = written(tmp_path, model)
    assert problems_of(file) == [
        f"{file}:3: plugin 'drive': <leftJoint> is 'left_whel', which is not a joint of /Robot; "
        "did you mean left_wheel?"
    ]
    assert problems_of(written(tmp_path, model.replace("whel", "wheel"))) == []


@pytest.mark.parametrize(("step", "asked"), [("1", True), ("0.001", False)])
def test_a_physics_step_of_a_second_is_asked_about(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], step: str, asked: bool
) -> None:
    physics = f'<physics name="p" type="ode"><max_step_size>{step}</max_step_size></physics>'
    file = written(tmp_path, f'<sdf version="1.9"><world name="w">{physics}</world></sdf>')
    assert main([file]) == 0
    warned = f"warning: {file}: the physics substep is 1 s" in capfd.readouterr().err
    assert warned is asked
