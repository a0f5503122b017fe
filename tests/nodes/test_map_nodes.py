# SPDX-License-Identifier: BSD-3-Clause
"""The nodes that serve and save maps."""

import subprocess
from pathlib import Path

import numpy as np
import pytest

from bubblesim.navigation.map_files import read_map
from node_types import Ask, Start
from ros_support import DEADLINE

LISTEN = """
from nav_msgs.srv import GetMap
maps, metadata = [], []
rospy.Subscriber("map", OccupancyGrid, maps.append)
rospy.Subscriber("map_metadata", MapMetaData, metadata.append)
wait_until(lambda: maps and metadata, "the map")
rospy.wait_for_service("static_map", 30)
asked = rospy.ServiceProxy("static_map", GetMap)().map
info = maps[0].info
print(json.dumps({
    "frame": maps[0].header.frame_id, "data": list(maps[0].data), "size": [info.width, info.height],
    "resolution": info.resolution,
    "origin": [info.origin.position.x, info.origin.position.y, info.origin.orientation.z],
    "same": asked == maps[0] and metadata[0] == info,
}))
"""

PICTURE = b"P5\n3 2\n255\n" + bytes([0, 205, 254, 254, 254, 0])
DESCRIPTION = (
    "image: room.pgm\nresolution: 0.5\norigin: [-1, 2, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
)


@pytest.fixture
def room(tmp_path: Path) -> Path:
    (tmp_path / "room.pgm").write_bytes(PICTURE)
    (tmp_path / "room.yaml").write_text(DESCRIPTION)
    return tmp_path / "room.yaml"


def test_a_map_is_served_from_its_files(node: Start, ask: Ask, room: Path) -> None:
    node("map_server", room, "__ns:=/served", "_frame_id:=hall")
    seen = ask(LISTEN, "__ns:=/served")
    assert seen["data"] == [0, 0, 100, 100, -1, 0]
    assert (seen["frame"], seen["size"], seen["same"]) == ("hall", [3, 2], True)
    assert (seen["resolution"], seen["origin"]) == (0.5, [-1.0, 2.0, 0.0])


def test_what_is_served_can_be_saved_again(node: Start, room: Path, tmp_path: Path) -> None:
    node("map_server", room, "__ns:=/again")
    saver = node("map_saver", "-f", tmp_path / "copy", "__ns:=/again", stdout=subprocess.PIPE)
    output, _ = saver.communicate(timeout=3 * DEADLINE)
    assert (saver.returncode, output.strip()) == (0, f"{tmp_path}/copy.yaml")
    assert (tmp_path / "copy.pgm").read_bytes() == PICTURE
    np.testing.assert_array_equal(read_map(tmp_path / "copy.yaml").cells, read_map(room).cells)


def test_a_map_that_cannot_be_served_is_reported(node: Start, tmp_path: Path) -> None:
    server = node("map_server", tmp_path / "nowhere.yaml", stderr=subprocess.PIPE)
    _, errors = server.communicate(timeout=3 * DEADLINE)
    assert server.returncode == 2
    assert "nowhere.yaml" in errors
    assert "Traceback" not in errors


@pytest.mark.parametrize("arguments", [["--occ"], ["--occ", "high"], ["--free", "70"], ["-x", "1"], ["--occ", "101"]])
def test_arguments_that_map_saver_cannot_take_are_reported(node: Start, arguments: list[str]) -> None:
    saver = node("map_saver", *arguments, stderr=subprocess.PIPE)
    _, errors = saver.communicate(timeout=3 * DEADLINE)
    assert saver.returncode == 2
    assert "usage: map_saver" in errors
