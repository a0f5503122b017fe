# SPDX-License-Identifier: BSD-3-Clause
"""The bridge as a node: its names, its time, and a master that starts late, hangs or disappears."""

import time
import xmlrpc.client
from pathlib import Path
from typing import Any

from bridge_probe import Probe
from ros_support import RosCore, free_port, ros_environment, wait_until

NAME = "/sim_ros_interface"
BOUND = 2.0
"""Seconds within which a bridge must end, whatever its master does."""
SLACK = 5.0
"""Extra time for starting and ending a process on a busy machine."""


def test_node_is_listed_under_its_name(roscore: RosCore) -> None:
    with Probe(roscore.env):
        wait_until(lambda: NAME in roscore.nodes(), "the node")
        assert NAME in roscore.run("rosnode", "list").split()


def test_start_states_where_it_connected(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        expected = f"plugin 'ROSInterface': load succeeded: node {NAME} at ROS master http://localhost:{roscore.port}"
        probe.wait_for(lambda: expected in probe.errors, "the line")
        # A master that takes more than a second, as on a busy machine, is missed at first.
        assert [line for line in probe.errors if "load failed" not in line] == [expected]
        probe.wait_for(lambda: probe.ask("connected") == "yes", "the connection")


def test_name_remapping_renames_the_node(roscore: RosCore) -> None:
    with Probe(roscore.env, "__name:=other", "__ns:=/robots") as probe:
        assert probe.ask("name") == "/robots/other"
        wait_until(lambda: "/robots/other" in roscore.nodes(), "the node")


def test_relative_names_are_below_the_node(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        for topic in ("speed", "~steering", "/absolute"):
            probe.ask("advertise", topic, "float")
        wanted = {f"{NAME}/speed", f"{NAME}/steering", "/absolute"}
        wait_until(lambda: wanted <= set(roscore.state()["publishers"]), "the topics")


def test_topic_remapping_applies(roscore: RosCore) -> None:
    with Probe(roscore.env, "/speed:=/robot/speed", "~own:=/other") as probe:
        probe.ask("advertise", "/speed", "float")
        probe.ask("subscribe", "own", "float")
        wait_until(lambda: "/robot/speed" in roscore.state()["publishers"], "the publisher")
        wait_until(lambda: "/other" in roscore.state()["subscribers"], "the subscriber")


def test_missing_master_is_reported_with_uri_and_cure(tmp_path: Path) -> None:
    port = free_port()
    with Probe(ros_environment(port, tmp_path)) as probe:
        probe.wait_for(lambda: bool(probe.errors), "the line")
        assert probe.errors == [
            f"plugin 'ROSInterface': load failed (failed initialization): no ROS master at http://localhost:{port};"
            " start one with 'roscore' -- the simulation continues without ROS and connects as soon as a master appears"
        ]
        assert probe.ask("connected") == "no"


def test_endpoints_come_alive_when_a_master_appears(tmp_path: Path) -> None:
    port = free_port()
    with Probe(ros_environment(port, tmp_path)) as probe:
        publisher = probe.ask("advertise", "/map", "float", "latch")
        subscriber = probe.ask("subscribe", "/map", "float")
        probe.ask("publish", publisher, 1.0)
        probe.ask("publish", publisher, 2.0)
        with RosCore(tmp_path, port) as core:
            probe.wait_for(lambda: probe.messages(subscriber) == ["2.000000"], "what was latched last")
            wait_until(lambda: NAME in core.nodes(), "the node")


def test_unset_master_uri_means_the_usual_one(tmp_path: Path) -> None:
    env = ros_environment(1, tmp_path)
    del env["ROS_MASTER_URI"]
    with Probe(env) as probe:
        probe.wait_for(lambda: "at http://localhost:11311" in probe.errors[0] if probe.errors else False, "its URI")


def test_clock_is_published(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        wait_until(lambda: NAME in roscore.state()["publishers"].get("/clock", []), "/clock to be advertised")
        subscriber = probe.ask("subscribe", "/clock", "clock")
        wait_until(lambda: NAME in roscore.state()["subscribers"].get("/clock", []), "the subscriber")

        def arrives() -> bool:  # the node connects to itself after the master knows both
            probe.ask("clock", 3.25)
            return bool(probe.messages(subscriber))

        probe.wait_for(arrives, "the clock")
        assert probe.messages(subscriber)[0] == "3 250000000"


def test_clock_is_left_to_a_script_that_advertises_it(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        subscriber = probe.ask("subscribe", "/clock", "clock")
        publisher = probe.ask("advertise", "/clock", "clock")
        probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "the connection to itself")
        probe.ask("clock", 1.0)
        probe.ask("publish", publisher, 7)
        probe.wait_for(lambda: probe.messages(subscriber) == ["7 0"], "the script's clock")
        probe.ask("shutdown_publisher", publisher)
        probe.ask("clock", 2.0)
        probe.wait_for(lambda: probe.messages(subscriber) == ["7 0", "2 0"], "the simulator's clock again")
        probe.ask("advertise", "/clock", "clock")
    assert [line for line in probe.errors if "/clock" in line] == [
        "plugin 'ROSInterface': a script advertises /clock: the simulator does not publish it"
    ]


def test_now_is_the_wall_clock_without_use_sim_time(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        probe.ask("clock", 12.5)
        before = time.time()
        seconds, nanoseconds = map(int, probe.ask("now").split())
        assert before - 1e-3 < seconds + nanoseconds * 1e-9 < time.time() + 1e-3


def test_now_is_simulation_time_under_use_sim_time(roscore: RosCore) -> None:
    roscore.set_param("/use_sim_time", True)
    with Probe(roscore.env) as probe:
        probe.wait_for(lambda: probe.ask("connected") == "yes", "the parameter to be read")
        assert probe.ask("now") == "0 0"
        probe.ask("clock", 12.05)
        assert probe.ask("now") == "12 50000000"


def test_pause_services_notify_the_application(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        wait_until(lambda: f"{NAME}/unpause" in roscore.state()["services"], "the services")
        roscore.run("rosservice", "call", f"{NAME}/pause")
        probe.wait_for(lambda: "paused" in probe.events, "the call")
        roscore.run("rosservice", "call", f"{NAME}/unpause")
        probe.wait_for(lambda: "unpaused" in probe.events, "the call")


def test_sigterm_leaves_nothing_at_the_master(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        probe.ask("advertise", "/out", "float")
        probe.ask("subscribe", "/in", "float")
        wait_until(lambda: NAME in roscore.state()["subscribers"].get("/in", []), "the endpoints")
        took = probe.terminate()
        assert NAME not in roscore.nodes() or took > 1.0  # which a busy master gets
        assert probe.process.returncode == 0


def test_ends_in_time_while_no_master_answers(tmp_path: Path) -> None:
    with Probe(ros_environment(free_port(), tmp_path)) as probe:
        probe.ask("advertise", "/out", "float")
        assert probe.terminate() < BOUND + SLACK
        assert probe.process.returncode == 0


def test_ends_in_time_while_the_master_hangs(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        for index in range(20):
            probe.ask("advertise", f"/out{index}", "float")
            probe.ask("subscribe", f"/in{index}", "float")
        wait_until(lambda: NAME in roscore.state()["subscribers"].get("/in19", []), "the endpoints")
        roscore.pause()
        assert probe.terminate() < BOUND + SLACK
        assert probe.process.returncode == 0


def test_ends_in_time_while_a_registration_hangs(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        roscore.pause()
        probe.ask("advertise", "/out", "float")
        time.sleep(0.2)  # until the call is in progress
        assert probe.terminate() < BOUND + SLACK
        assert probe.process.returncode == 0


def test_ends_in_time_when_the_master_hung_from_the_start(roscore: RosCore) -> None:
    roscore.pause()
    with Probe(roscore.env) as probe:
        assert probe.terminate() < BOUND + SLACK
        assert probe.process.returncode == 0
    assert "load failed (failed initialization)" in probe.errors[0]


def test_ends_in_time_after_the_master_died(tmp_path: Path) -> None:
    with RosCore(tmp_path) as core:
        probe = Probe(core.env)
    with probe:
        probe.ask("advertise", "/out", "float")
        assert probe.terminate() < BOUND + SLACK
        assert probe.process.returncode == 0


def test_simulation_does_not_wait_for_a_hanging_master(roscore: RosCore) -> None:
    with Probe(roscore.env) as probe:
        publisher = probe.ask("advertise", "/out", "float")
        subscriber = probe.ask("subscribe", "/out", "float")
        probe.wait_for(lambda: probe.ask("wants", publisher) == "yes", "the connection to itself")
        gone = probe.ask("advertise", "/gone", "float")
        wait_until(lambda: "/gone" in roscore.state()["publishers"], "the publisher")
        roscore.pause()
        probe.ask("shutdown_publisher", gone)
        probe.ask("advertise", "/new", "float")
        probe.ask("shutdown_subscriber", subscriber)
        for _ in range(3):
            assert probe.ask("publish", publisher, 1.0) == ""
            time.sleep(0.1)


def test_simulation_survives_a_shutdown_of_its_node_by_a_peer(roscore: RosCore) -> None:
    master: Any = xmlrpc.client.ServerProxy(roscore.env["ROS_MASTER_URI"])
    with Probe(roscore.env) as probe:
        publisher = probe.ask("advertise", "/map", "float", "latch")
        wait_until(lambda: NAME in roscore.state()["publishers"].get("/map", []), "the node")
        _, _, address = master.lookupNode("/peer", NAME)
        xmlrpc.client.ServerProxy(address).shutdown("/peer", "a test")
        probe.wait_for(lambda: probe.ask("connected") == "no", "the node to be shut down")
        assert probe.ask("publish", publisher, 1.0) == ""
        assert "invalid" not in probe.ask("advertise", "/other", "float")
        assert probe.terminate() < BOUND + SLACK
        assert probe.process.returncode == 0
