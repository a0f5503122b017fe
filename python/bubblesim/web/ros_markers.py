# SPDX-License-Identifier: BSD-3-Clause
"""Markers of ROS nodes for one page: all topics of visualization_msgs/Marker and MarkerArray.

A marker is in a frame of tf. For each frame that is used the page gets its ancestors with its pose in them; it knows
which of them are links of the scene.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from typing import Any

import numpy as np

from bubblesim.web.ros_topics import node
from bubblesim.web.threads import in_thread

_OWN = "/bubblesim/drawings"  # pages have the drawings of scripts from the simulator
_KINDS = ("visualization_msgs/Marker", "visualization_msgs/MarkerArray")
_BETWEEN_SCANS = 2.0  # s between two searches for topics
_MOST_MARKERS = 5000
_MOST_POINTS = 200_000  # of one marker
_DEEPEST = 100  # frames
_ADD, _DELETE, _DELETE_ALL = 0, 2, 3

Pose = list[float]  # x, y, z (m) and the quaternion x, y, z, w


class PageMarkers:
    """The markers that the topics hold now. Empty until the first ``changes``."""

    def __init__(self) -> None:
        """Subscribe to nothing yet."""
        self._lock = threading.Lock()
        self._subscribing = threading.Lock()
        self._subscribers: dict[str, Any] = {}
        self._markers: dict[tuple[str, str, int], tuple[dict[str, Any], float]] = {}
        self._parents: dict[str, tuple[str, Pose]] = {}
        self._revision = 0
        self._next_scan = 0.0

    async def changes(self, since: int) -> dict[str, Any]:
        """Return the ``revision``, all ``markers`` if it is not ``since``, and the ``frames`` that they are in."""
        if time.monotonic() >= self._next_scan:
            self._next_scan = time.monotonic() + _BETWEEN_SCANS
            await in_thread(self._scan)
        now = time.monotonic()
        with self._lock:
            for key in [key for key, (_, end) in self._markers.items() if end < now]:
                del self._markers[key]
                self._revision += 1
            markers = [marker for marker, _ in self._markers.values()]
            frames = {frame: list(self._ancestors(frame)) for frame in {marker["frame"] for marker in markers}}
            changes: dict[str, Any] = {"revision": self._revision, "frames": frames}
            if since != self._revision:
                changes["markers"] = markers
            return changes

    async def close(self) -> None:
        """End all subscriptions."""
        await in_thread(self._end)

    def _end(self) -> None:
        with self._subscribing:
            for subscriber in self._subscribers.values():
                subscriber.unregister()
            self._subscribers.clear()
        with self._lock:
            self._markers.clear()
            self._revision += 1
        self._next_scan = 0.0

    def _scan(self) -> None:
        with self._subscribing:
            self._subscribe(node())

    def _subscribe(self, rospy: Any) -> None:
        from tf2_msgs.msg import TFMessage
        from visualization_msgs.msg import Marker, MarkerArray

        for topic, kind in rospy.get_published_topics():
            if topic in self._subscribers or topic == _OWN or kind not in _KINDS:
                continue
            message = Marker if kind == _KINDS[0] else MarkerArray
            self._subscribers[topic] = rospy.Subscriber(topic, message, self._receive, topic, queue_size=20)
        for topic in ("/tf", "/tf_static"):
            if topic not in self._subscribers:
                self._subscribers[topic] = rospy.Subscriber(topic, TFMessage, self._place, queue_size=100)

    def _receive(self, message: Any, topic: str) -> None:
        with self._lock:
            for marker in getattr(message, "markers", [message]):
                key = (topic, marker.ns, marker.id)
                if marker.action == _ADD and (key in self._markers or len(self._markers) < _MOST_MARKERS):
                    lifetime = marker.lifetime.to_sec()
                    self._markers[key] = (_plain(marker), time.monotonic() + lifetime if lifetime > 0 else float("inf"))
                elif marker.action == _DELETE:
                    self._markers.pop(key, None)
                elif marker.action == _DELETE_ALL:
                    for each in [each for each in self._markers if each[0] == topic]:
                        del self._markers[each]
            self._revision += 1

    def _place(self, message: Any) -> None:
        with self._lock:
            for each in message.transforms:
                moved, turned = each.transform.translation, each.transform.rotation
                pose = [moved.x, moved.y, moved.z, turned.x, turned.y, turned.z, turned.w]
                self._parents[each.child_frame_id.lstrip("/")] = (each.header.frame_id.lstrip("/"), pose)

    def _ancestors(self, frame: str) -> Iterator[tuple[str, list[Pose]]]:
        """Yield the frame and its ancestors, each with the poses whose product is that of the frame in it."""
        poses: list[Pose] = []
        yield frame, []
        for _ in range(_DEEPEST):
            if frame not in self._parents:
                return
            frame, pose = self._parents[frame]
            poses = [pose, *poses]
            yield frame, poses


def _plain(marker: Any) -> dict[str, Any]:
    """Return a marker as numbers, strings and bytes (32 bit floats)."""
    place, turn, size, colour = marker.pose.position, marker.pose.orientation, marker.scale, marker.color
    points = [(p.x, p.y, p.z) for p in marker.points[:_MOST_POINTS]]
    colours = [(c.r, c.g, c.b) for c in marker.colors[:_MOST_POINTS]]
    turned = [turn.x, turn.y, turn.z, turn.w]
    return {
        "frame": marker.header.frame_id.lstrip("/"),
        "type": marker.type,
        "position": [place.x, place.y, place.z],
        "orientation": turned if any(turned) else [0.0, 0.0, 0.0, 1.0],
        "scale": [size.x, size.y, size.z],
        "colour": [colour.r, colour.g, colour.b, colour.a],
        "points": np.array(points, dtype=np.float32).tobytes(),
        "colours": np.array(colours, dtype=np.float32).tobytes() if len(colours) == len(points) else b"",
        "text": marker.text,
    }


async def changes(page: Any, since: int) -> dict[str, Any]:
    """See PageMarkers.changes."""
    found: dict[str, Any] = await page.markers.changes(since)
    return found


async def end(page: Any) -> None:
    """End the subscriptions of a page."""
    await page.markers.close()
