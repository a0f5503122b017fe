# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that clients load and close."""

from pathlib import Path

import pytest

from node_support import run_sim, write
from remote_support import RemoteNode, refusal
from ros_support import RosCore, wait_until
from service_caller import ServiceCaller

NODE = "/sim_ros_interface"

MODEL = """\
<?xml version="1.0"?>
<sdf version="1.9">
  <world name="{name}">
    <model name="{model}">
      <link name="link"><visual name="v"><geometry><sphere><radius>0.1</radius></sphere></geometry></visual></link>
    </model>
  </world>
</sdf>
"""


def scene(folder: Path, name: str, model: str) -> Path:
    folder.mkdir(exist_ok=True)
    return write(folder / f"{name}.sdf", MODEL.format(name=name, model=model))


def test_a_node_without_a_scene_waits_for_one(tmp_path: Path) -> None:
    with RemoteNode(tmp_path, "--speed", "max", scene="") as node:
        sim = node.sim()
        assert sim.getStringParam(sim.stringparam_scene_name) == ""
        assert sim.getObjectAlias(sim.getObject("/ground_plane")) == "ground_plane"
        assert sim.loadScene("tricycle") == 1
        assert sim.getStringParam(sim.stringparam_scene_name) == "tricycle"
        sim.setStepping(True)
        sim.startSimulation()
        sim.setJointTargetVelocity(sim.getObject("/FrontMotor"), 2.0)
        for _ in range(20):
            sim.step()
        assert sim.getSimulationTime() == pytest.approx(1.0)
        sim.stopSimulation()
        assert sim.loadScene("") == 1
        assert sim.getObject("/Tricycle", {"noError": True}) == -1
    assert run_sim("--no-ros").returncode == 2


def test_a_scene_of_the_original_is_found_by_its_name(node: RemoteNode) -> None:
    sim = node.sim()
    car = sim.getObject("/Tricycle")
    assert sim.loadScene("C:\\scenes\\pioneer.ttt") == 1
    assert "no object matches '/Tricycle'" in refusal(sim.getObject, "/Tricycle")
    assert sim.loadScene("/somewhere/tricycle.ttt") == 1
    assert sim.getObject("/Tricycle") == car
    missing = refusal(sim.loadScene, "/somewhere/nowhere.ttt")
    assert "there is no scene 'nowhere'; searched: " in missing
    assert "scenes/nowhere.sdf" in missing
    assert str(Path.cwd() / "nowhere.sdf") in missing
    assert "there is no model 'nothing'" in refusal(sim.loadModel, "../../nothing.ttm")


def test_a_scene_with_errors_leaves_the_present_one(tmp_path: Path) -> None:
    folder = tmp_path / "scenes"
    first = scene(folder, "first", "One")
    write(folder / "wrong.sdf", "<sdf version='1.9'><world name='w'><model name='m'><link/></model></world></sdf>")
    with RemoteNode(tmp_path, scene=str(first)) as node:
        sim = node.sim()
        assert "wrong.sdf" in refusal(sim.loadScene, "wrong.ttt")
        assert "first.sdf: contains a <world>: expected a <model>" in refusal(sim.loadModel, "first.ttm")
        assert sim.getObject("/One") >= 0


def test_a_scene_is_read_again_when_it_is_loaded_again(tmp_path: Path) -> None:
    file = scene(tmp_path / "scenes", "mine", "One")
    with RemoteNode(tmp_path, scene=str(file)) as node:
        sim = node.sim()
        sim.createDummy(0.1)
        sim.setStringSignal("text", "here")
        scene(file.parent, "mine", "Two")
        assert sim.loadScene("mine.ttt") == 1
        assert sim.getObject("/Two") >= 0
        assert sim.getObject("/Dummy", {"noError": True}) == -1
        assert sim.getStringSignal("text") is None


def test_clients_stay_with_their_stepping_when_the_scene_changes(node: RemoteNode) -> None:
    one, two = node.sim(), node.sim()
    one.setStepping(True)
    assert two.loadScene("ball") == 1
    two.startSimulation()
    assert two.getSimulationTime() == 0
    one.step()
    assert two.getSimulationTime() == pytest.approx(0.05)
    assert one.loadScene("tricycle") == 1  # while it runs; the stop ends the stepping
    one.startSimulation()
    two.wait(0.5)


def test_a_closed_scene_leaves_a_floor(node: RemoteNode) -> None:
    sim = node.sim()
    assert sim.closeScene() == 1
    roots = [sim.getObjectAlias(handle) for handle in sim.getObjectsInTree(sim.handle_scene, sim.handle_all, 2)]
    assert roots == ["ground_plane"]
    sim.startSimulation()
    sim.wait(0.2)


def test_scenes_change_many_times(node: RemoteNode) -> None:
    sim = node.sim()
    for _ in range(10):
        for name in ("ball", "tricycle"):
            sim.loadScene(name)
            sim.startSimulation()
            sim.wait(0.1)


def test_ros_nodes_see_the_topics_of_the_scene_that_is_loaded(roscore: RosCore, tmp_path: Path) -> None:
    def published() -> set[str]:
        return {topic for topic, nodes in roscore.state()["publishers"].items() if NODE in nodes}

    with RemoteNode(tmp_path, environment=roscore.env) as node:
        sim = node.sim()
        for _ in range(3):
            sim.startSimulation()
            wait_until(lambda: "/front_sonar" in published(), "the tricycle's topics")
            assert sim.loadScene("bubblerob") == 1
            wait_until(lambda: not published() & {"/front_sonar", "/odom"}, "the tricycle's topics to be gone")
            sim.startSimulation()
            wait_until(lambda: "/notifications" in published(), "BubbleRob's topics")
            stamps = [roscore.echo("/clock") for _ in range(2)]
            assert stamps[0] != stamps[1]
            assert sim.loadScene("tricycle") == 1
        with ServiceCaller(roscore) as call:  # services are registered anew with each scene
            wait_until(
                lambda: call(f"{NODE}/get_object_state", object="/Tricycle").get("success"), "the state of the tricycle"
            )
        sim.stopSimulation()


SCRIPT = """
    def sysCall_init():
        sim.setStringSignal('script', 'replaced')
"""


def test_the_scripts_of_the_command_line_stay_with_their_scene(tmp_path: Path) -> None:
    script = write(tmp_path / "script.py", SCRIPT)
    with RemoteNode(tmp_path, "--child-script", f"/Ball={script}", "--speed", "max", scene="ball") as node:
        sim = node.sim()
        sim.loadScene("tricycle")
        sim.loadScene("ball")
        sim.startSimulation()
        sim.wait(0.1)
        assert sim.getStringSignal("script") == "replaced"


def test_a_scene_that_ends_with_the_node_is_not_changed(tmp_path: Path) -> None:
    with RemoteNode(tmp_path, "--until", 5) as node:
        assert "started with --until" in refusal(node.sim().loadScene, "ball")


def test_paths_are_for_trusted_clients(tmp_path: Path) -> None:
    file = scene(tmp_path / "elsewhere", "mine", "One")
    with RemoteNode(tmp_path) as node:
        assert "there is no scene 'mine'" in refusal(node.sim().loadScene, str(file))
        assert "must not start" in refusal(node.sim().launchExecutable, "/bin/true")
        assert "remote-trusted" not in node.output
    with RemoteNode(tmp_path, "--remote-trusted") as node:
        sim = node.sim()
        assert "warning: --remote-trusted: remote clients can start any program" in node.output
        assert sim.loadScene(str(file.with_suffix(".ttt"))) == 1
        assert sim.getObject("/One") >= 0
        assert sim.launchExecutable("/bin/true") > 0
