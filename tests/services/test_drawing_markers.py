# SPDX-License-Identifier: BSD-3-Clause
"""Drawing objects as markers on /bubblesim/drawings."""

import math
from pathlib import Path

import numpy as np
import pytest

from bubblesim.scene_state.drawings import Drawings, Style
from bubblesim.services.drawing_markers import markers_of
from node_support import Node, findings_of, write
from ros_support import RosCore

HEADER = {"frame_id": "world", "stamp": 1.5}
IDENTITY = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
QUARTER = math.sqrt(0.5)


def drawn(style: Style, *items: list[float]) -> Drawings:
    drawings = Drawings()
    handle = drawings.create(0, style, capacity=100).handle
    for item in items:
        assert drawings.add_item(handle, item)
    return drawings


def markers(style: Style, *items: list[float], pose: list[float] = IDENTITY) -> list[dict]:
    return markers_of(drawn(style, *items).by_handle[1], pose, HEADER)


def points(marker: dict) -> np.ndarray:
    return np.array([[point[axis] for axis in "xyz"] for point in marker["points"]])


def test_an_empty_drawing_has_no_marker() -> None:
    assert markers(Style("points")) == []
    assert markers(Style("linestrip"), [0, 0, 0]) == []


@pytest.mark.parametrize(
    ("kind", "item", "marker_type", "count"),
    [
        ("points", [1, 2, 3], 8, 1),
        ("lines", [1, 2, 3, 4, 5, 6], 5, 2),
        ("triangles", [0, 0, 0, 1, 0, 0, 0, 1, 0], 11, 3),
        ("sphere", [1, 2, 3], 7, 1),
        ("triangle", [1, 2, 3, 0, 0, 0, 1], 11, 3),
        ("quad", [1, 2, 3, 0, 0, 0, 1], 11, 6),
        ("cube", [1, 2, 3, 0, 0, 0, 1], 11, 36),
    ],
)
def test_each_kind_has_its_marker(kind: str, item: list[float], marker_type: int, count: int) -> None:
    (marker,) = markers(Style(kind, 0.5, (1.0, 0.5, 0.0), opacity=0.25), item, item)
    assert (marker["type"], len(marker["points"])) == (marker_type, 2 * count)
    assert marker["color"] == {"r": 1.0, "g": 0.5, "b": 0.0, "a": 0.25}
    assert marker["header"] == HEADER
    assert "colors" not in marker


def test_shapes_have_their_size_and_normal() -> None:
    turned = [0.0, QUARTER, 0.0, QUARTER]  # z to x
    for kind, height in (("disc", 0.0), ("quad", 0.0), ("cube", 0.5)):
        (marker,) = markers(Style(kind, 0.5), [1, 2, 3, *turned])
        corners = points(marker) - [1, 2, 3]
        assert np.ptp(corners[:, 0]) == pytest.approx(height, abs=1e-6)
        assert np.ptp(corners[:, 1]) == pytest.approx(0.5, abs=1e-6)
        assert np.ptp(corners[:, 2]) == pytest.approx(0.5, abs=1e-6)


def test_items_with_sizes_and_colours() -> None:
    style = Style("sphere", colours=3, has_sizes=True, has_transparencies=True)
    pose = [10.0, 0.0, 0.0, 0.0, 0.0, QUARTER, QUARTER]  # x to y
    first, second = markers(style, [1, 0, 0, 1, 0, 0, 0.2, 0], [0, 0, 1, 0, 0, 1, 0.4, 0.75], pose=pose)
    assert (first["type"], first["id"], second["id"]) == (2, 0, 1)
    assert first["pose"]["position"] == pytest.approx({"x": 10, "y": 1, "z": 0})
    assert second["scale"]["x"] == pytest.approx(0.4)
    assert second["color"] == {"r": 0, "g": 0, "b": 1, "a": 0.25}
    (strip,) = markers(Style("linestrip", colours=3), [0, 0, 0, 1, 0, 0], [1, 0, 0, 0, 1, 0])
    assert [colour["g"] for colour in strip["colors"]] == [0, 1]
    (lines,) = markers(Style("lines", colours=6), [0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0])
    assert [colour["g"] for colour in lines["colors"]] == [0, 1]


SCRIPT = """
def sysCall_init():
    self.ball = sim.getObject('/Ball')
    self.dots = sim.addDrawingObject(sim.drawing_points, 3, 0, self.ball, 100, [1, 0, 0])
    sim.addDrawingObjectItem(self.dots, sim.getObjectPosition(self.ball))
    self.other = sim.addDrawingObject(sim.drawing_points, 3)
    sim.addDrawingObjectItem(self.other, [1, 2, 3])
    simROS.advertiseService('/remove_other', 'std_srvs/Empty', 'remove_other')
def remove_other(request):
    sim.removeDrawingObject(self.other)
"""

PROBE = """
import json
import rospy
from std_srvs.srv import Empty
from visualization_msgs.msg import MarkerArray

deleted = False
shown = {}

def receive(array):
    global deleted
    for marker in array.markers:
        if marker.action == 2:
            deleted = True
        else:
            at = marker.pose.position, marker.points[0]
            shown[marker.ns] = [marker.header.frame_id, marker.type] + [getattr(p, a) for p in at for a in 'xyz']

rospy.init_node('probe')
rospy.Subscriber('/bubblesim/drawings', MarkerArray, receive)
rospy.wait_for_service('/remove_other')
while len(shown) < 2 and not rospy.is_shutdown():
    rospy.sleep(0.05)
rospy.ServiceProxy('/remove_other', Empty)()
while not deleted and not rospy.is_shutdown():
    rospy.sleep(0.05)
print(json.dumps({'shown': shown}), flush=True)
rospy.spin()
"""


def test_they_are_published_to_subscribers_in_the_frame_of_the_scene(roscore: RosCore, tmp_path: Path) -> None:
    script = write(tmp_path / "script.py", SCRIPT)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}"):
        shown = findings_of(PROBE, roscore.env, tmp_path)["shown"]
    assert shown["2"] == ["world", 8, 0, 0, 0, 1, 2, 3]
    frame, kind, _, _, z, *point = shown["1"]
    assert (frame, kind) == ("world", 8)
    assert point == pytest.approx([0, 0, 0], abs=1e-6)  # in the ball, whose pose is that of the marker
    assert z > 0
