# SPDX-License-Identifier: BSD-3-Clause
"""Services of the node and of nodes of ROS 2, both ways."""

from pathlib import Path

from node_support import Node, write
from ros2_peer import Domain, Ros2Peer

SET_BOOL, TRIGGER, EMPTY = "std_srvs/srv/SetBool", "std_srvs/srv/Trigger", "std_srvs/srv/Empty"


def node_with(domain: Domain, folder: Path, script: str, *options: object) -> Node:
    file = write(folder / "script.py", script)
    return Node(domain.env(), folder / "log", "ball", "--ros=2", "--child-script", f"/Ball={file}", *options)


SERVER = """
    def sysCall_init():
        simROS2.createService('/paint', 'std_srvs/srv/SetBool', 'paint')
        simROS2.createService('/refuse', 'std_srvs/Trigger', 'refuse')

    def paint(request):
        return {'success': request['data'], 'message': 'painted'}

    def refuse(request):
        raise RuntimeError('out of paint')
"""


def test_ros2_calls_a_script(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    with node_with(ros2_domain, tmp_path, SERVER):
        assert ros2_peer.call("/paint", SET_BOOL, data=True) == {"success": True, "message": "painted"}
        assert ros2_peer.call("/paint", SET_BOOL, data=False) == {"success": False, "message": "painted"}


def test_a_failure_is_in_the_fields_for_it_and_in_the_log(
    ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    with node_with(ros2_domain, tmp_path, SERVER) as node:
        response = ros2_peer.call("/refuse", TRIGGER)
        assert response["success"] is False
        assert "out of paint" in response["message"]
        node.wait_for_output("service '/refuse' failed: ")


CLIENT = """
    def sysCall_init():
        self.client = simROS2.createClient('/switch', 'std_srvs/srv/SetBool')
        self.calls = 0

    def sysCall_sensing():
        if self.calls < 2 and simROS2.waitForService('/switch', 0.0):
            self.calls += 1
            response = simROS2.call(self.client, {'data': self.calls == 1})
            print('answered', response, flush=True)
"""


def test_a_script_calls_ros2(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    ros2_peer.serve("/switch", SET_BOOL, success=True, message="switched")
    with node_with(ros2_domain, tmp_path, CLIENT) as node:
        node.wait_for_output("answered {'success': True, 'message': 'switched'}", 2)
    assert ros2_peer.requests("/switch") == [{"data": True}, {"data": False}]


def test_services_that_are_not_there_or_of_another_type_are_reported(
    ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    ros2_peer.serve("/switch", SET_BOOL, success=True)
    script = """
        def sysCall_init():
            simROS2.waitForService('/switch', 60.0)
            for name in ('/nobody', '/switch'):
                client = simROS2.createClient(name, 'std_srvs/srv/Trigger')
                try:
                    simROS2.call(client, {}, 1.0)
                except Exception as error:
                    print('failed:', error, flush=True)
    """
    with node_with(ros2_domain, tmp_path, script) as node:
        node.wait_for_output("failed:", 2)
        assert "service '/nobody' was not found within 1 s" in node.output
        assert "service '/switch' is of type std_srvs/SetBool, not std_srvs/Trigger" in node.output


def test_the_services_of_the_node_control_it(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    script = """
        def sysCall_init():
            pass

        def sysCall_suspend():
            print('paused', flush=True)

        def sysCall_resume():
            print('goes on', flush=True)
    """
    with node_with(ros2_domain, tmp_path, script) as node:
        ros2_peer.call("/sim_ros2_interface/pause", EMPTY)
        node.wait_for_output("paused")
        ros2_peer.call("/sim_ros2_interface/unpause", EMPTY)
        node.wait_for_output("goes on")
        services = ros2_peer.graph()["services"]
    assert services["/sim_ros2_interface/step"] == ["bubblesim_msgs/srv/Step"]
    assert services["/sim_ros2_interface/get_object_state"] == ["bubblesim_msgs/srv/GetObjectState"]


def test_a_node_calls_its_own_service(ros2_domain: Domain, tmp_path: Path) -> None:
    script = """
        def sysCall_init():
            simROS2.createService('/double', 'std_srvs/srv/SetBool', 'double')
            client = simROS2.createClient('/double', 'std_srvs/srv/SetBool')
            print(simROS2.call(client, {'data': True}), flush=True)

        def double(request):
            return {'success': request['data'], 'message': 'own'}
    """
    with node_with(ros2_domain, tmp_path, script) as node:
        node.wait_for_output("{'success': True, 'message': 'own'}")


def test_a_script_calls_a_service_of_a_type_that_ros2_alone_has(ros2_domain: Domain, tmp_path: Path) -> None:
    script = """
        def sysCall_init():
            client = simROS2.createClient('~/list_parameters', 'rcl_interfaces/srv/ListParameters')
            print('names', simROS2.call(client, {})['result']['names'], flush=True)
    """
    with node_with(ros2_domain, tmp_path, script) as node:
        node.wait_for_output("names ['use_sim_time'")
