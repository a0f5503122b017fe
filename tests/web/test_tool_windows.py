# SPDX-License-Identifier: BSD-3-Clause
"""Panels of the window that need a scene or a master of their own, in a real browser."""

import os
import signal
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import rosbag

pytest.importorskip("playwright")

from node_support import write
from ros_peer import Peer
from ros_support import RosCore, start, stop, wait_until
from tools_page import ToolsPage


def test_cameras_are_live(tmp_path: Path) -> None:
    with ToolsPage(tmp_path, "sensors") as window:
        window.show("cameras")
        window.page.wait_for_selector(".camera canvas")
        pictures = "[...document.querySelectorAll('.camera canvas')]"
        pixels = "c.getContext('2d').getImageData(0, 0, c.width, c.height).data"
        window.wait_for(f"{pictures}.every(c => c.width > 1 && new Set({pixels}).size > 8)")
        notes = f"{pictures}.map(c => c.parentElement.textContent).join()"
        before = window.page.evaluate(notes)
        window.wait_for(f"{notes} !== {before!r}")
        assert window.errors == []


NOTE_READINGS = """(() => {
  const { link } = bubblesim;
  const call = link.call.bind(link);
  window.readings = []; // [begin, end, duration of the measurement] in ms
  link.call = async (name, ...rest) => {
    const begin = performance.now();
    const result = await call(name, ...rest);
    if (name === "window.reading") window.readings.push([begin, performance.now(), 1000 * result.duration]);
    return result;
  };
})()"""


def test_pictures_of_cameras_take_a_tenth_of_the_time_of_the_simulator(tmp_path: Path) -> None:
    with ToolsPage(tmp_path, "sensors") as window:  # with two cameras
        window.page.evaluate(NOTE_READINGS)
        window.show("cameras")
        window.wait_for("window.readings.length >= 6")
        readings = window.page.evaluate("window.readings")
        for first, second, following in zip(readings[0::2], readings[1::2], readings[2::2], strict=False):
            assert following[0] - second[1] > 9 * (first[2] + second[2])
        assert window.errors == []


def test_a_script_in_lua_is_checked_while_it_is_typed(tmp_path: Path) -> None:
    script = write(tmp_path / "ball.lua", "function sysCall_init()\n    print('from Lua')\nend\n")
    with ToolsPage(tmp_path, "ball", "--child-script", f"/Ball={script}") as window:
        window.page.wait_for_selector(".entryrow:has-text('from Lua')")
        window.show("scripts")
        window.page.wait_for_selector(".cm-content:has-text('sysCall_init')")
        window.page.click(".cm-content")
        window.page.keyboard.press("Control+End")
        window.page.keyboard.type("function broken(")
        window.page.wait_for_selector(".cm-lint-marker-error")
        assert window.errors == []


SCENE_WITH_A_MISTAKE = """\
<sdf version="1.9">
  <world name="mistake">
    <model name="box"><static>true</static>
      <link name="link">
        <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
        <colour>red</colour>
      </link>
    </model>
  </world>
</sdf>
"""


def test_a_warning_of_the_scene_leads_to_its_object(tmp_path: Path) -> None:
    with ToolsPage(tmp_path, str(write(tmp_path / "mistake.sdf", SCENE_WITH_A_MISTAKE))) as window:
        window.show("problems")
        row = window.page.locator(".problem", has_text="colour")
        row.wait_for()
        assert row.locator(".where").inner_text() == "mistake.sdf:6"
        row.click()
        window.wait_for("bubblesim.selection.object?.path === '/box/link'")
        assert window.errors == []


@pytest.mark.parametrize(("kind", "before"), [("Twist", "TwistStamped"), ("TwistStamped", "Twist")])
def test_driving_publishes_what_a_robot_takes_and_stops_with_the_page(
    roscore: RosCore, tmp_path: Path, kind: str, before: str
) -> None:
    roscore.run("rostopic", "pub", "-1", "/drive_here", f"geometry_msgs/{before}", "{}")  # the master keeps its type
    with ToolsPage(tmp_path, "ball", env=roscore.env) as window, Peer(roscore, tmp_path / "peer.txt") as peer:

        def velocities() -> list[list[float]]:
            twists = [each.get("twist", each) for each in peer.received("/drive_here", f"geometry_msgs/{kind}")]
            return [[twist["linear"]["x"], twist["angular"]["z"]] for twist in twists]

        wait_until(lambda: not velocities() and "/drive_here" in roscore.state()["subscribers"], "the peer")
        window.show("driving")
        window.page.fill(".driving input >> nth=0", "/drive_here")
        window.page.click(".drive")
        window.page.keyboard.down("w")
        wait_until(lambda: velocities().count([0.5, 0.0]) > 4, "velocities")
        window.page.close()  # with the key down: the server stops the robot
        wait_until(lambda: velocities()[-1] == [0.0, 0.0], "the robot to be stopped")


def test_driving_without_a_subscriber_names_the_topics_that_have_one(roscore: RosCore, tmp_path: Path) -> None:
    with ToolsPage(tmp_path, "tricycle", env=roscore.env) as window:
        wait_until(lambda: "/steering" in roscore.state()["subscribers"], "the script")
        window.show("driving")
        window.page.fill(".driving input >> nth=0", "/cmd_vel")
        window.page.click(".drive")
        notice = window.page.locator(".driving .warning")
        notice.wait_for()
        assert notice.inner_text() == "No subscriber on /cmd_vel: nodes subscribe to /speed, /steering."
        with Peer(roscore, tmp_path / "peer.txt") as peer:
            peer.received("/cmd_vel", "geometry_msgs/Twist")
            wait_until(lambda: "/cmd_vel" in roscore.state()["subscribers"], "the peer")
            for _ in range(2):  # leave the controls, and take them again
                window.page.click(".drive")
            window.wait_for("document.querySelector('.driving .warning').hidden")


def test_commands_that_come_at_once_are_carried_out_in_their_order(roscore: RosCore, tmp_path: Path) -> None:
    with ToolsPage(tmp_path, "ball", env=roscore.env) as window:
        drives = [f"bubblesim.link.call('server.drive', ['/{topic}', 0.5, 0, 0])" for topic in ("left", "driven")]
        window.page.evaluate(f"Promise.all([{', '.join(drives)}])")  # both while the server becomes a node

        def published() -> dict[str, list[str]]:
            return roscore.state()["publishers"]

        wait_until(lambda: "/driven" in published() and "/left" not in published(), "the first topic to be left")


def test_the_stick_drives_a_robot_and_a_page_without_focus_stops_it(roscore: RosCore, tmp_path: Path) -> None:
    with ToolsPage(tmp_path, "pioneer", env=roscore.env) as window:
        wait_until(lambda: "/cmd_vel" in str(roscore.state()["subscribers"]), "the robot")
        window.show("driving")
        window.page.click(".drive")
        robot = window.call("sim.getObject", "/Pioneer_p3dx")

        def speed() -> float:
            return float(np.linalg.norm(window.call("sim.getObjectVelocity", robot)[0]))

        stick = window.page.locator(".stick").bounding_box()
        assert stick
        x, y = stick["x"] + stick["width"] / 2, stick["y"] + stick["height"] / 2
        for stopped_by in ("mouse up", "blur"):
            window.page.mouse.move(x, y)
            window.page.mouse.down()
            window.page.mouse.move(x, y - 0.4 * stick["height"], steps=3)
            wait_until(lambda: speed() > 0.2, "the robot to drive")
            if stopped_by == "blur":
                window.page.evaluate("window.dispatchEvent(new Event('blur'))")
            window.page.mouse.up()
            wait_until(lambda: speed() < 0.02, f"the robot to stop after {stopped_by}")
        assert window.errors == []


PUBLISHER = """\
def sysCall_init():
    self.stamped = simROS.advertise('/stamped', 'geometry_msgs/PointStamped')
    self.plain = simROS.advertise('/t', 'std_msgs/Float64')

def sysCall_sensing():
    t = sim.getSimulationTime()
    simROS.publish(self.stamped, {'header': {'stamp': t + 1}, 'point': {'x': t + 6}})
    simROS.publish(self.plain, {'data': t})
"""


def test_a_field_of_a_topic_is_plotted_and_a_bag_recorded(roscore: RosCore, tmp_path: Path) -> None:
    script = write(tmp_path / "script.py", PUBLISHER)
    with ToolsPage(tmp_path, "ball", "--child-script", f"/Ball={script}", env=roscore.env) as window:
        window.show("plots")
        wait_until(lambda: "/t" in roscore.state()["publishers"], "the script's topic")
        topics = dict(window.call("server.topics"))
        assert topics["/t"] == "std_msgs/Float64"
        assert window.call("server.topicFields", "/t") == ["data"]
        series = "bubblesim.plots.plots[{}].series[0].series"
        begin = time.time()
        for number, (topic, field) in enumerate((("/stamped", "point.x"), ("/t", "data"))):
            window.page.evaluate("x => bubblesim.plot('topic', x).then(() => 0)", [topic, field])
            window.wait_for(f"{series.format(number)}.times.length > 5")
        found = [window.page.evaluate(f"(({{times, values}}) => [times, values])({series.format(i)})") for i in (0, 1)]
        (stamps, values), (arrivals, times) = found
        assert np.subtract(values, stamps) == pytest.approx(5, abs=1e-6)
        assert begin <= arrivals[0] <= arrivals[-1] <= time.time()  # without a stamp: when it came
        assert arrivals == sorted(arrivals)
        assert times == sorted(times)
        window.show("record")
        window.page.wait_for_selector(".record option:text-is('/t')", state="attached")
        window.page.select_option(".record select", "/t")
        window.page.click("button:has-text('Record a bag')")
        window.page.wait_for_selector("button:has-text('End the recording')")
        wait_until(lambda: any("record" in node for node in roscore.state()["subscribers"].get("/t", [])), "rosbag")
        end = window.page.evaluate("bubblesim.link.frame.time") + 1.5
        window.wait_for(f"bubblesim.link.frame.time > {end}")
        window.page.click("button:has-text('End the recording')")
        window.page.wait_for_selector(".record .hint:has-text('Recorded to')")
        bags = list(tmp_path.glob("bubblesim_*.bag"))
        assert len(bags) == 1
        with rosbag.Bag(str(bags[0])) as bag:
            assert bag.get_message_count("/t") > 0
        window.page.click("button:has-text('Record a bag')")

        def is_open() -> bool:
            runs = window.call("server.recording")["runs"]
            opened = list(tmp_path.glob("bubblesim_*.bag.active"))
            assert opened or not runs, "rosbag leaves no file if it is ended while it starts"
            return bool(opened)

        wait_until(is_open, "the second bag to be opened")
        window.page.wait_for_selector("button:has-text('End the recording')")
        assert window.errors == []
    # The second one ends with the server.
    wait_until(lambda: len(list(tmp_path.glob("bubblesim_*.bag"))) == 2, "the second bag")


def test_a_bag_is_recorded_when_its_file_is_closed(roscore: RosCore, tmp_path: Path) -> None:
    with ToolsPage(tmp_path, "ball", env=roscore.env) as window:
        window.call("server.startRecording", ["/clock"])
        wait_until(lambda: any("record" in node for node in roscore.state()["subscribers"].get("/clock", [])), "rosbag")
        recorder = next(node for node in roscore.state()["subscribers"]["/clock"] if "record" in node)
        pid = roscore.pid_of(recorder)
        os.kill(pid, signal.SIGSTOP)  # as on a slow disk
        window.page.evaluate(
            """() => {
              window.ended = false;
              bubblesim.link.call("server.stopRecording", []).then(() => { window.ended = true; });
            }"""
        )
        window.page.wait_for_timeout(1500)
        assert not window.page.evaluate("window.ended")
        os.kill(pid, signal.SIGCONT)
        window.wait_for("window.ended")
        assert len(list(tmp_path.glob("bubblesim_*.bag"))) == 1


MARKERS = """
import rospy
from geometry_msgs.msg import Point, TransformStamped
from std_msgs.msg import ColorRGBA
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

rospy.init_node('markers')
frames = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
several = rospy.Publisher('/several', MarkerArray, queue_size=1, latch=True)
one = rospy.Publisher('/one', Marker, queue_size=1, latch=True)
mount = TransformStamped()
mount.header.frame_id, mount.child_frame_id = 'Ball/link', 'mount'
mount.transform.translation.z = 0.5
mount.transform.rotation.w = 1.0
frames.publish(TFMessage([mount]))

def marker(frame, number, kind, x):
    made = Marker(ns='n', id=number, type=kind)
    made.header.frame_id = frame
    made.pose.position.x = x
    made.pose.orientation.w = 1.0
    made.scale.x = made.scale.y = made.scale.z = 0.2
    made.color = ColorRGBA(1.0, 0.0, 0.0, 1.0)
    made.points = [Point(0.0, 0.0, 0.0), Point(1.0, 0.0, 0.0)] if kind == Marker.LINE_STRIP else []
    made.text = 'here' if kind == Marker.TEXT_VIEW_FACING else ''
    return made

kinds = [Marker.ARROW, Marker.CUBE, Marker.SPHERE, Marker.LINE_STRIP, Marker.TEXT_VIEW_FACING]
several.publish(MarkerArray([marker('world', number, kind, 3.0) for number, kind in enumerate(kinds)]))
one.publish(marker('mount', 9, Marker.CUBE, 0.0))
rospy.spin()
"""


def test_markers_of_nodes_are_in_the_picture(roscore: RosCore, tmp_path: Path) -> None:
    program = start([sys.executable, "-c", MARKERS], roscore.env)
    with ToolsPage(tmp_path, "ball", env=roscore.env) as window:
        window.page.evaluate("bubblesim.view.setOverlay('ros_markers', true)")
        window.wait_for("bubblesim.rosMarkers?.length === 6")
        window.call("window.pause")  # the ball rolls
        window.wait_for("bubblesim.link.frame.state === 'paused'")
        window.page.wait_for_timeout(500)  # motion between two frames is interpolated
        window.page.evaluate("bubblesim.view.settled()")
        layer = "bubblesim.view.overlays.find(e => e.id === 'ros_markers').layer.object3d"
        place = f"(() => {{ const l = {layer}; l.updateMatrixWorld(true); return l.children.flatMap(h => h.children)"
        place += ".map(m => m.matrixWorld.elements.slice(12, 15)); })()"
        ball = window.call("window.get_state", window.page.evaluate("bubblesim.scene.byPath('/Ball/link').handle"))[
            "pose"
        ]
        window.wait_for(f"{place}.some(p => p[0] !== 3 && p[2] !== 0)")
        places = window.page.evaluate(place)
        assert places.count([3, 0, 0]) == 5
        mounted = next(each for each in places if each != [3, 0, 0])
        assert np.linalg.norm(np.subtract(mounted, ball[:3])) == pytest.approx(0.5, abs=0.01)
        stop(program)
        window.page.evaluate("bubblesim.view.setOverlay('ros_markers', false)")
        assert window.errors == []
