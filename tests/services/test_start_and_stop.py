# SPDX-License-Identifier: BSD-3-Clause
"""A simulation that other nodes stop and start while its node keeps running."""

import re
import socket
import time
from pathlib import Path

import pytest

from node_support import NAME, Node, run_script, without_slowness, write
from process_support import open_files
from remote_control import Run, wait_until_sent
from ros_support import DEADLINE, RosCore, free_port, wait_until

MASTER_CONNECTIONS = 2  # roscpp may keep these open between calls
RESTARTS = 5


def count(node: Node, text: str) -> int:
    return len(re.findall(rf"^{text}", node.output, re.MULTILINE))


def stands_still(node: Node) -> bool:
    before = count(node, "pass")
    time.sleep(0.3)
    return count(node, "pass") == before


def test_restarts_set_up_sockets_and_topics_again_and_leak_no_descriptors(run: Run, roscore: RosCore) -> None:
    port = free_port()
    code = f"""
        import socket, tempfile
        def sysCall_init():
            self.server = socket.create_server(('127.0.0.1', {port}))  # not closed, like those below
            print('init', sim.getSimulationTime(), sim.getSimulationState(), sim.getInt32Signal('left over'))
            sim.setInt32Signal('left over', 1)
            sim.setObjectPosition(sim.getObject('.'), [5, 5, 5])
            self.files = [tempfile.TemporaryFile() for _ in range(5)]
            self.received_at = simROS.advertise('/of_the_script', 'std_msgs/Float32')
            simROS.subscribe('/clock', 'rosgraph_msgs/Clock', lambda message: print('received'))
        def sysCall_actuation():
            simROS.publish(self.received_at, {{'data': sim.getSimulationTime()}})
        def sysCall_cleanup(): print('cleanup', sim.getSimulationState())
    """
    node, remote = run(code, "--paused", subscribe=["/of_the_script=Float32"])
    assert node.output.count("init ") == 0
    wait_until_sent(roscore.env, "/rosout")  # roscore's connection counts
    baseline = open_files(node.process.pid)
    for starts in range(1, RESTARTS + 1):
        received = count(node, "received"), len(remote.received("/of_the_script"))
        remote.press("start")
        wait_until(lambda starts=starts: count(node, "init") == starts, "the script to start")
        socket.create_connection(("127.0.0.1", port), timeout=DEADLINE).close()
        wait_until(lambda received=received: count(node, "received") > received[0], "the script's subscriber")
        wait_until(
            lambda received=received: len(remote.received("/of_the_script")) > received[1], "the script's publisher"
        )
        remote.press("stop")
        wait_until(lambda starts=starts: count(node, "cleanup") == starts, "the script to end")
        wait_until(lambda: "/of_the_script" not in roscore.state()["publishers"], "its topics to be gone")
        wait_until(
            lambda: open_files(node.process.pid) <= baseline + MASTER_CONNECTIONS, "the descriptors to be closed"
        )
    assert "x: 5.0" not in roscore.run("rosservice", "call", f"{NAME}/get_object_state", "object: /Ball")
    assert re.findall("^(?:init|cleanup).*", node.output, re.MULTILINE) == ["init 0.0 17 None", "cleanup 22"] * RESTARTS
    assert "error" not in node.output
    assert node.end() == 0


def test_a_server_in_a_thread_is_back_on_its_port_after_each_start(run: Run, roscore: RosCore) -> None:
    port = free_port()
    code = f"""
        import socket
        def sysCall_init(): print('init')
        def sysCall_thread():
            server = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
            server.bind(('127.0.0.1', {port}))
            server.listen()
            print('listens')
            while True:
                connection, _ = server.accept()
                connection.send(str(sim.getSimulationTime()).encode())
                connection.recv(1)
                connection.close()  # closes first, so the system keeps the port for a minute
        def sysCall_sensing(): print('pass')
        def sysCall_cleanup(): print('cleanup')
    """
    node, remote = run(code, "--paused")
    wait_until_sent(roscore.env, "/rosout")  # roscore's connection counts
    baseline = open_files(node.process.pid)
    for starts in range(1, RESTARTS + 1):
        remote.press("start")
        wait_until(lambda starts=starts: count(node, "listens") == starts, "the server")
        for _ in range(2):  # in sequence
            with socket.create_connection(("127.0.0.1", port), timeout=DEADLINE) as client:
                assert float(client.recv(100)) >= 0
                client.send(b"x")
                assert client.recv(1) == b""
        with socket.create_connection(("127.0.0.1", port), timeout=DEADLINE) as client:  # the server waits for it
            assert float(client.recv(100)) >= 0
            before = count(node, "pass")
            wait_until(lambda before=before: count(node, "pass") >= before + 3, "steps meanwhile")
            remote.press("stop")
            wait_until(lambda starts=starts: count(node, "cleanup") == starts, "the script to end")
            assert client.recv(1) == b""
    wait_until(lambda: open_files(node.process.pid) <= baseline + MASTER_CONNECTIONS, "the descriptors to be closed")
    assert "error" not in node.output
    assert "warning" not in without_slowness(node.output)
    assert node.end() == 0


def test_a_start_after_a_stop_reads_the_script_files_again(run: Run, tmp_path: Path) -> None:
    node, remote = run("def sysCall_init(): print('as it was')\ndef sysCall_cleanup(): print('cleanup')\n")
    node.wait_for_output("as it was")
    remote.press("stop")
    node.wait_for_output("cleanup")  # messages on two topics may arrive in any order
    write(tmp_path / "script.py", "def sysCall_init(): print('edited')\n")
    remote.press("start")
    node.wait_for_output("edited")


def test_a_pause_lets_scripts_and_time_stand_still(run: Run) -> None:
    node, remote = run(
        """
        def sysCall_init(): print('init')
        def sysCall_actuation(): print(f'pass {sim.getSimulationTime():.2f}')
    """,
        subscribe=["/simulationState=Int32"],
    )
    node.wait_for_output("pass 0.10")
    remote.press("pause")
    # It reports what it has received: a start that overtakes the pause would be without effect.
    wait_until(lambda: remote.received("/simulationState")[-1:] == ["2"], "the simulation to be paused")
    assert stands_still(node)
    remote.press("start")
    wait_until(lambda: count(node, "pass") > 20, "the simulation to continue")
    steps = re.findall(r"^pass (.*)", node.output, re.MULTILINE)
    assert steps == [f"{0.05 * i:.2f}" for i in range(len(steps))]
    assert count(node, "init") == 1


def test_a_slow_simulation_receives_a_stop_between_its_steps(run: Run) -> None:
    node, remote = run(
        "def sysCall_init(): print('init')\ndef sysCall_cleanup(): print('cleanup')\n", "--speed", "0.0001"
    )
    node.wait_for_output("init\n")
    remote.press("stop")
    node.wait_for_output("cleanup")


STOPPING = """
    def sysCall_init(): print('init')
    def sysCall_actuation(): sim.stopSimulation()
    def sysCall_cleanup():
        print('cleanup')
"""


def test_a_stop_by_a_script_leaves_the_node_where_others_can_start_it_again(run: Run, roscore: RosCore) -> None:
    node, remote = run(STOPPING)
    node.wait_for_output("cleanup")
    answer = roscore.run("rosservice", "call", f"{NAME}/step", "steps: 1")
    assert "the simulation is stopped" in answer
    roscore.run("rosservice", "call", f"{NAME}/reset_simulation")
    assert count(node, "init") == 1
    remote.press("start")
    wait_until(lambda: count(node, "cleanup") == 2, "the second run")


def test_a_script_may_start_again_what_it_stops(run: Run) -> None:
    node, _ = run(STOPPING + "        sim.startSimulation()\n")
    wait_until(lambda: count(node, "cleanup") >= 3, "the third run")


def test_a_stop_ends_a_run_that_has_an_end(roscore: RosCore, tmp_path: Path) -> None:
    file = write(tmp_path / "script.py", STOPPING)
    options = ["--until", 1e6, "--child-script", f"/Ball={file}"]
    with Node(roscore.env, tmp_path / "log", "ball", *options) as node:
        assert node.process.wait(timeout=DEADLINE) == 0
        assert without_slowness(node.output).endswith("init\ncleanup\n")


@pytest.mark.parametrize("call", ["stopSimulation", "quitSimulator"])
def test_a_script_ends_a_node_without_ros(tmp_path: Path, call: str) -> None:
    code = STOPPING.replace("stopSimulation", call)
    run = run_script(tmp_path, code, until=1e6)
    assert (run.returncode, run.stdout, run.stderr) == (0, "init\ncleanup\n", "")


def test_a_script_ends_the_node_in_ros(run: Run) -> None:
    node, remote = run("def sysCall_init(): pass\ndef sysCall_actuation(): sim.quitSimulator()\n", "--paused")
    remote.press("start")
    assert node.process.wait(timeout=DEADLINE) == 0
