# SPDX-License-Identifier: BSD-3-Clause
"""The services and the action of simulation_interfaces in ROS 2. rclpy has no such package, so scripts are the clients;
ROS 2's own generator computes the hashes of the definitions."""

import json
import re
import subprocess
from pathlib import Path

import pytest

from bubblesim import _core
from node_support import Node, write
from ros2_peer import PEERS, Domain, peer_environment
from ros_support import REPOSITORY, SUPPORT

ROS2 = _core.messages.RosVersion.ROS2

CLIENT = """
    AT_ONCE = -1

    def sysCall_init():
        def response(goal_id, accepted):
            print('accepted', accepted, flush=True)
            if {cancelled_after} == AT_ONCE:
                simROS2.cancelLastGoal(self.client)
        def feedback(goal_id, message):
            print('feedback', message['completed_steps'], message['remaining_steps'], flush=True)
            if message['completed_steps'] == {cancelled_after}:
                simROS2.cancelLastGoal(self.client)
        def result(goal_id, code, message):
            print('result', code, message['result']['result'], message['result']['error_message'], flush=True)
        kind = 'simulation_interfaces/action/SimulateSteps'
        self.client = simROS2.createActionClient('/simulate_steps', kind, response, feedback, result)
        simROS2.sendGoal(self.client, {{'steps': {steps}}})
        if {paused}:
            sim.pauseSimulation()

    def sysCall_sensing():
        print('at', round(sim.getSimulationTime(), 3), flush=True)
"""


def node_with(domain: Domain, folder: Path, script: str, *options: str) -> Node:
    file = write(folder / "script.py", script)
    return Node(domain.env(), folder / "log", "ball", "--ros=2", "--child-script", f"/Ball={file}", *options)


def test_the_action_runs_steps_with_feedback(ros2_domain: Domain, tmp_path: Path) -> None:
    with node_with(ros2_domain, tmp_path, CLIENT.format(steps=3, paused=True, cancelled_after=0)) as node:
        node.wait_for_output("result 4 1")
        steps = re.findall("^(?:feedback|accepted|result).*", node.output, re.MULTILINE)
    # Clients of ROS 2 drop the feedback that comes after the result.
    assert steps == ["accepted True", "feedback 1 2", "feedback 2 1", "feedback 3 0", "result 4 1 "]


def test_a_cancelled_action_runs_no_more_steps(ros2_domain: Domain, tmp_path: Path) -> None:
    with node_with(ros2_domain, tmp_path, CLIENT.format(steps=1_000_000, paused=True, cancelled_after=3)) as node:
        node.wait_for_output("result 5 1")
        assert len(re.findall("^at", node.output, re.MULTILINE)) < 1000


def test_a_cancelled_action_whose_step_is_held_back_is_cancelled(ros2_domain: Domain, tmp_path: Path) -> None:
    script = CLIENT.format(steps=3, paused=True, cancelled_after=-1)
    with node_with(ros2_domain, tmp_path, script, "--lockstep", "/never_published") as node:
        node.wait_for_output("result 5 1")  # not 6: aborted because the step was given up
        assert "feedback" not in node.output


def test_the_action_of_a_simulation_that_plays_is_aborted(ros2_domain: Domain, tmp_path: Path) -> None:
    with node_with(ros2_domain, tmp_path, CLIENT.format(steps=3, paused=False, cancelled_after=0)) as node:
        node.wait_for_output("result 6 4 the simulation is running: pause it first")


def test_services_answer_in_the_layout_of_ros2(ros2_domain: Domain, tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            def ask(name, kind, **request):
                return simROS2.call(simROS2.createClient(name, 'simulation_interfaces/srv/' + kind), request)
            features = ask('/get_simulator_features', 'GetSimulatorFeatures')['features']
            print('action', 33 in list(features['features']), features['spawn_formats'], flush=True)
            print('entities', ask('/get_entities', 'GetEntities')['entities'], flush=True)
            print('state', ask('/get_simulation_state', 'GetSimulationState')['state'], flush=True)
    """
    with node_with(ros2_domain, tmp_path, code) as node:
        node.wait_for_output("state {'state': 1}")
        assert "action True ['sdf', 'urdf']" in node.output
        assert "'Ball'" in node.output


@pytest.mark.parametrize("package", ["simulation_interfaces", "bubblesim_msgs"])
def test_hashes_are_those_of_ros2s_generator(package: str, ros2_domain: Domain, tmp_path: Path) -> None:
    command = [PEERS / "bin" / "python", SUPPORT / "ros2_type_hashes.py", REPOSITORY / "msg" / package, tmp_path]
    run = subprocess.run(command, env=peer_environment(ros2_domain), capture_output=True, text=True, check=True)
    hashes = {name: value for name, value in json.loads(run.stdout.splitlines()[-1]).items() if package in name}
    messages = {name: value for name, value in hashes.items() if "/msg/" in name}
    services = {
        name: value for name, value in hashes.items() if re.fullmatch(r"\w+/srv/[^_]+", name)
    }  # without their parts
    assert len(messages) + len(services) > 6
    assert {name: _core.messages.type_hash(name.replace("/msg/", "/"), ROS2) for name in messages} == messages
    assert {name: _core.messages.service_type_hash(name.replace("/srv/", "/"), ROS2) for name in services} == services
