# SPDX-License-Identifier: BSD-3-Clause
"""Models that sim.loadModel finds by the names of CoppeliaSim's model browser: their names, objects and scripts."""

from pathlib import Path

from browser_support import script
from bubblesim.scripting.api.sim.browser_models import BROWSER_MODELS, PAGE, BrowserModel, browser_model
from node_support import in_init, run_script
from ros_support import REPOSITORY

UR_JOINT, FRANKA_JOINT = "/joint/link" * 5 + "/joint", "/joint/link2_resp/joint/link3_resp/joint"
OBJECTS = {  # of the programs that people write for them
    "PioneerP3DX": "leftMotor rightMotor ultrasonicSensor[0] ultrasonicSensor[15]",
    "ePuck": "base leftJoint/leftRespondableWheel rightJoint/rightRespondableWheel proxSensor[0] proxSensor[7] "
    "lightSensor camera ledLight",
    "LineTracer": "DynamicLeftJoint DynamicRightJoint LeftSensor MiddleSensor RightSensor LineTracerBase",
    "bubbleRob": "leftMotor/leftWheel rightMotor/rightWheel sensingNose visionSensor connection/slider",
    "Quadcopter": "base target propeller[0]/respondable propeller[3]/joint floorCamera",
    "UR3": f"{UR_JOINT[1:]} connection link1_visible link7_visible",
    "UR5": f"{UR_JOINT[1:]} link/joint connection link7_visible",
    "UR10": f"{UR_JOINT[1:]} connection link7_visible",
    "Franka": f"{FRANKA_JOINT[1:]} link2_resp/joint link8_resp/connection FrankaGripper/openCloseJoint "
    "FrankaGripper/attachProxSensor",
    "RG2": "openCloseJoint attachPoint attachProxSensor",
    "youBot": "rollingJoint_fl rollingJoint_rl rollingJoint_rr rollingJoint_fr "
    "youBotArmJoint0/youBotArmJoint1/youBotArmJoint2 youBotArmJoint4 youBotGripperJoint1 youBotGripperJoint2",
    "dr12": "leftJoint_ rightJoint_ bumperForceSensor_ sonar",
    "dr20": "leftWheelJoint_ rightWheelJoint_ infraredSensor1_ infraredSensor6_ ultrasonicSensor_",
    "Kilobot": "Revolute_jointLeftLeg Revolute_jointRightLeg Proximity_sensor Vision_sensor BatHold MsgSensor",
    "BarrettHand": "jointA_0/spread_0/jointB_0/proximal_0/jointC_0 jointA_2 jointB_1 jointC_2 attachPoint",
    "conveyor": "drive/forwarder end",
    "Bill": "goalDummy leftLegJoint rightKneeJoint leftAnkleJoint rightShoulderJoint leftElbowJoint rightHand_tip neck",
}
FILES = [(file, model.object) for model in BROWSER_MODELS for file in model.files]


def test_a_script_loads_each_file_of_the_browser_by_any_path(tmp_path: Path) -> None:
    body = f"""
for file, name in {FILES}:
    old = file.upper().replace(' ', '_')
    for path in (f'./models/some folder/{{file}}.ttm', f'C:\\\\Program Files\\\\models\\\\{{old}}.ttm'):
        model = sim.loadModel(path)
        assert sim.getObjectAlias(model) in (name, name + '_2'), (path, sim.getObjectAlias(model))
        sim.removeModel(model)
"""
    script(tmp_path, body)


def test_the_objects_have_the_names_that_programs_use(tmp_path: Path) -> None:
    files = {model.object: model.files[0] for model in reversed(BROWSER_MODELS)}
    body = f"""
sim.removeModel(sim.getObject('/PioneerP3DX'))
for name, parts in {OBJECTS}.items():
    model = sim.loadModel({files}[name] + '.ttm')
    assert sim.getObject('/' + name) == model and sim.getModelProperty(model) == 0
    for part in parts.split():
        assert sim.isHandle(sim.getObject(f'/{{name}}/{{part}}')), part
    sim.removeModel(model)
"""
    script(tmp_path, body)


def test_an_unknown_name_is_an_error_with_the_nearest_one(tmp_path: Path) -> None:
    body = """
error = refused(sim.loadModel, 'models/robots/mobile/pionier p3dx.ttm')
assert "there is no model 'pionier p3dx'" in error
assert "did you mean 'pioneer p3dx'?" in error
assert 'docs/models_of_the_browser.md lists' in error
"""
    script(tmp_path, body)


def test_a_file_beside_the_scene_comes_first(tmp_path: Path) -> None:
    text = '<sdf version="1.9"><model name="own"><static>true</static><link name="only"/></model></sdf>'
    (tmp_path / "line tracer.sdf").write_text(text)
    floor = '<sdf version="1.9"><world name="w"><include><uri>model://floor</uri></include></world></sdf>'
    (tmp_path / "scene.sdf").write_text(floor)
    code = in_init("model = sim.loadModel('line tracer.ttm')\nassert sim.getObject('./only', {'proxy': model}) > 0")
    run = run_script(tmp_path, code, "--strict", scene=str(tmp_path / "scene.sdf"), target="/Floor")
    assert (run.stderr, run.returncode) == ("", 0)


def test_the_scripts_of_all_models_run_for_ten_seconds(tmp_path: Path) -> None:
    files = [model.files[0] for model in BROWSER_MODELS if isinstance(model, BrowserModel)]
    body = f"""
for i, file in enumerate({files}):
    model = sim.loadModel(file + '.ttm')
    x, y, z = sim.getObjectPosition(model)
    sim.setObjectPosition(model, [3 * (i % 4) - 4, 3 * (i // 4) - 6, z])
"""
    script(tmp_path, body, until=10)


def test_old_names_find_the_parts(tmp_path: Path) -> None:
    body = """
files = 'e-puck, Quadricopter, UR5, KUKA YouBot, Standing Bill, dr12, dr20, Kilobot, BarrettHand, conveyor'
for file in files.split(', '):
    sim.loadModel(file + '.ttm')
old_names = 'ePuck_leftJoint ePuck_proxSensor8 Quadricopter_target UR5_joint6 rollingJoint_fl Bill_goalDummy '
old_names += 'dr12_leftJoint_ dr20_leftWheelJoint_ Kilobot_Revolute_jointLeftLeg BarrettHand_jointA_0 '
old_names += 'ConveyorBelt_forwarder'
for name in old_names.split():
    assert sim.isHandle(sim.getObjectHandle(name))
"""
    script(tmp_path, body)


def test_the_page_lists_each_model_with_its_object() -> None:
    rows = [line for line in (REPOSITORY / PAGE).read_text().splitlines() if line.startswith("| `")]
    listed = {file for row in rows for file in row.split("|")[1].replace("`", "").strip().split(", ")}
    for model in BROWSER_MODELS:
        if isinstance(model, BrowserModel):
            row = next(row for row in rows if f"`{model.files[0]}`" in row)
            assert f"`/{model.object}`" in row
            assert set(model.files) <= listed


def test_a_name_of_the_table_stands_for_one_model() -> None:
    assert len({file for file, _ in FILES}) == len(FILES)
    assert all(browser_model(f"models/{file}.ttm") is not None for file, _ in FILES)
