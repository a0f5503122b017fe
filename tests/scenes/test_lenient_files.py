# SPDX-License-Identifier: BSD-3-Clause
"""Files with mistakes that Gazebo accepts: they load, and one warning describes each replacement."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import bubblesim

GEOMETRY = "<geometry><sphere><radius>1</radius></sphere></geometry>"
JOINT = "<joint name='j' type='revolute'><parent>l</parent><child>k</child>{axis}</joint>"
Load = Callable[..., tuple[bubblesim.Simulation, list[str]]]


@pytest.fixture
def load(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> Load:
    """Load a string as a file; return the simulation and the lines of stderr, without the file's name."""

    def load_text(text: str, name: str = "scene.sdf") -> tuple[bubblesim.Simulation, list[str]]:
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        capfd.readouterr()
        simulation = bubblesim.Simulation(str(file))
        simulation.step(2)
        return simulation, [line.replace(f"{file}:", "") for line in capfd.readouterr().err.splitlines()]

    return load_text


def model(link: str = "", more: str = "", version: str = "1.6") -> str:
    return f'<sdf version="{version}">\n<model name="m">\n<link name="l">\n{link}</link>\n{more}</model></sdf>'


def world(text: str) -> str:
    return f'<sdf version="1.6">\n<world name="w">\n{text}\n</world></sdf>'


def collision(surface: str) -> str:
    return f"<collision name='c'>{GEOMETRY}<surface>{surface}</surface></collision>"


def lidar(vertical: str) -> str:
    return (
        "<sensor name='s' type='ray'><ray><scan><horizontal><samples>3</samples><min_angle>-1</min_angle>"
        f"<max_angle>1</max_angle></horizontal><vertical>{vertical}</vertical></scan><range><min>0.1</min><max>9</max>"
        "</range></ray></sensor>"
    )


def camera(field_of_view: float) -> str:
    return (
        f"<sensor name='s' type='camera'><camera><horizontal_fov>{field_of_view}</horizontal_fov><image>"
        "<width>8</width><height>8</height></image><clip><near>0.1</near><far>9</far></clip></camera></sensor>"
    )


def inertia(ixx: float, iyy: float, izz: float) -> str:
    return f"<inertial><mass>1</mass><inertia><ixx>{ixx}</ixx><iyy>{iyy}</iyy><izz>{izz}</izz></inertia></inertial>"


@pytest.mark.parametrize(
    ("text", "warning"),
    [
        pytest.param(
            model(f"<visual name='v'>{GEOMETRY}<material><script><name>Gazebo/Red</name></script></material></visual>"),
            "4: /m/l/v: <script> has no <uri>: 'Gazebo/Red' is searched in Gazebo's materials",
            id="script_without_uri",
        ),
        pytest.param(
            model(f"<visual name='v'>{GEOMETRY}<material><script>Gazebo/Red</script></material></visual>"),
            "4: /m/l/v: <script> has text and no <name>: 'Gazebo/Red' is used as the material's name",
            id="script_with_text",
        ),
        pytest.param(
            model(
                "</link><link name='k'>",
                JOINT.format(axis="<axis><xyz>0 0 1</xyz><limit><lower>-1e9</lower><upper>1</upper></limit></axis>"),
            ),
            "5: /m/j: the lower limit is -1e+09, beyond 1e6: treated as no limit",
            id="limit",
        ),
        pytest.param(
            model(collision("<friction><ode><mu>-1</mu></ode></friction>")),
            "4: /m/l/c: <mu> is -1: using infinite friction",
            id="mu",
        ),
        pytest.param(
            model(collision("<friction><ode><mu></mu></ode></friction>")),
            "4: /m/l/c: <mu> is empty: using the default 1",
            id="empty",
        ),
        pytest.param(
            model(collision("<friction><ode><mu>slippery</mu></ode></friction>")),
            "4: /m/l/c: <mu> is 'slippery', which cannot be read: using the default 1",
            id="odd_number",
        ),
        pytest.param(
            model(collision("<friction><ode><mu>1e400</mu></ode></friction>")),
            "4: /m/l/c: <mu> is '1e400', out of the range of numbers: using inf",
            id="number_beyond_all",
        ),
        pytest.param(
            model("", "<self_collide>1.0</self_collide>"),
            "5: /m: <self_collide> is '1.0': using true",
            id="odd_flag",
        ),
        pytest.param(
            model(f"<visual name='v'>{GEOMETRY}<material><diffuse>255 0 0 1</diffuse></material></visual>"),
            "4: /m/l/v: <diffuse> is '255 0 0 1', colour values must be from 0 to 1: using 1 0 0 1",
            id="colour",
        ),
        pytest.param(
            model(lidar("<samples>3</samples><min_angle>0.2</min_angle><max_angle>-0.2</max_angle>")),
            "4: /m/l/s: the vertical angles are 0.2 to -0.2 rad: using them from low to high",
            id="reversed_vertical_angles",
        ),
        pytest.param(
            model(lidar("<samples>1</samples><min_angle>-0.2</min_angle><max_angle>0.2</max_angle>")),
            "4: /m/l/s: 1 vertical samples from -0.2 to 0.2 rad: using a single ring at 0 rad",
            id="one_vertical_sample",
        ),
        pytest.param(
            model(lidar("<samples>0</samples>")),
            "4: /m/l/s: 0 vertical samples from 0 to 0 rad: using a single ring at 0 rad",
            id="no_vertical_sample",
        ),
        pytest.param(
            model(camera(3.13)),
            "4: /m/l/s: the horizontal field of view is 3.13 rad: objects ahead are tiny in such an image",
            id="field_of_view",
        ),
        pytest.param(
            model(inertia(-1, 1, 2)),
            "3: /m/l: the inertia is ixx iyy izz (-1, 1, 2), ixy ixz iyz (0, 0, 0), which is not positive definite: "
            "using the nearest that is, ixx iyy izz (0.002, 1, 2), ixy ixz iyz (0, 0, 0)",
            id="inertia",
        ),
        pytest.param(
            world("<model name='m'><link name='l'/></model>\n<model name='m'><link name='l'/></model>"),
            "4: /m_2: renamed: another model has the name 'm'",
            id="models_of_one_name",
        ),
        pytest.param(
            model("</link><model name='arm'><link name='hand'/></model><link name='k'>",
                  "<joint name='j' type='fixed'><parent>l</parent><child>m::arm::hand</child></joint>", "1.9"),
            "5: /m/j: the child 'm::arm::hand' is not found: using arm::hand",
            id="child_of_an_inner_model",
        ),
    ],
)  # fmt: skip
def test_one_warning_states_what_is_taken(load: Load, text: str, warning: str) -> None:
    assert load(text)[1] == [f"warning: {warning}"]


def test_a_comment_may_stand_before_the_declaration(load: Load) -> None:
    assert load("<!-- mine -->\n<?xml version='1.0'?>\n" + model())[1] == []


def test_friction_below_zero_holds_a_block_on_a_steep_ramp(load: Load) -> None:
    def sliding(mu: str) -> float:
        surface = f"<surface><friction><ode><mu>{mu}</mu><mu2>{mu}</mu2></ode></friction></surface>"
        box = "<collision name='c'><geometry><box><size>{}</size></box></geometry>" + surface + "</collision>"
        simulation, _ = load(
            world(
                "<model name='ramp'><static>true</static><pose>0 0 0 0 0.9 0</pose><link name='l'>"
                + box.format("9 9 1")
                + "</link></model><model name='block'><pose>0.4308 0 0.3419 0 0.9 0</pose><link name='l'>"
                + box.format("0.4 0.4 0.1")
                + "</link></model>"
            )
        )
        block = next(each for each in simulation.objects if each.path == "/block")
        start = np.array(block.position)
        simulation.step(round(1.0 / simulation.time_step))
        return float(np.linalg.norm(np.array(block.position) - start))

    assert sliding("-1") < 0.05
    assert sliding("0.2") > 0.5


def test_a_collision_without_its_mesh_is_left_out(load: Load) -> None:
    mesh = "<collision name='lost'><geometry><mesh><uri>model://nowhere/a.stl</uri></mesh></geometry></collision>"
    simulation, warnings = load(model(mesh + f"<collision name='c'>{GEOMETRY}</collision>"))
    assert len(warnings) == 1
    assert warnings[0].startswith("warning: 4: /m/l/lost: file not found: 'model://nowhere/a.stl';")
    assert warnings[0].endswith("; this collision is ignored")
    assert [shape.kind for shape in simulation.collisions if shape.object_path == "/m/l"] == ["sphere"]


def test_a_model_may_be_named_with_three_slashes(load: Load, tmp_path: Path) -> None:
    (tmp_path / "crate").mkdir()
    (tmp_path / "crate" / "model.sdf").write_text(model().replace('"m"', '"crate"'))
    (tmp_path / "crate" / "model.config").write_text(
        "<model><name>crate</name><sdf version='1.6'>model.sdf</sdf></model>"
    )
    simulation, warnings = load(world("<include><uri>model:///crate</uri></include>"))
    assert warnings == ["warning: 3: <uri> is 'model:///crate': using model://crate"]
    assert any(each.path == "/crate" for each in simulation.objects)


def test_included_files_are_repaired_and_named_in_warnings(load: Load, tmp_path: Path) -> None:
    folder = tmp_path / "models" / "crate"
    folder.mkdir(parents=True)
    text = model(collision("<friction><ode><mu>-1</mu></ode></friction>")).replace('"m"', '"crate"')
    (folder / "model.sdf").write_text("<!-- by me -->\n<?xml version='1.0'?>\n" + text)
    (folder / "model.config").write_text("<model><name>crate</name><sdf version='1.6'>model.sdf</sdf></model>")
    include = "<include><uri>model://crate</uri></include>\n"
    simulation, warnings = load(world(include * 3))
    assert warnings == [
        f"warning: {folder}/model.sdf:6: /crate/l/c: <mu> is -1: using infinite friction",
        "warning: 4: /crate_2: renamed: another model has the name 'crate'",
        "warning: 5: /crate_3: renamed: another model has the name 'crate'",
    ]
    assert {"/crate", "/crate_2", "/crate_3"} <= {each.path for each in simulation.objects}


def test_extensions_of_urdf_are_repaired(load: Load) -> None:
    sensor = "<sensor name='s' type='imu'><update_rate>often</update_rate></sensor>"
    _, warnings = load(
        "<robot name='r'><link name='base'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
        "izz='1'/></inertial></link>\n<gazebo reference='base'><mu1>-1</mu1></gazebo>\n"
        f"<gazebo reference='base'>{sensor}</gazebo></robot>",
        "r.urdf",
    )
    assert warnings == [
        "warning: 2: /r/base: <mu1> is below 0: using infinite friction",
        "warning: 3: /r/base/s: <update_rate> is 'often', which cannot be read: using the default 0",
    ]


@pytest.mark.parametrize(
    ("text", "name"),
    [
        (model("<kinematic>true</kinematic>"), "kinematic"),
        (model("<projector name='p'><texture>t.png</texture></projector>"), "projector"),
        (model("<battery name='b'><voltage>12</voltage></battery>"), "battery"),
    ],
)
def test_what_is_left_out_is_reported(load: Load, text: str, name: str) -> None:
    _, warnings = load(text)
    assert [f"<{name}> is ignored: " in warning for warning in warnings] == [True], warnings


def test_what_would_have_no_effect_is_not_reported(load: Load) -> None:
    assert load(model("<kinematic>false</kinematic>"))[1] == []
