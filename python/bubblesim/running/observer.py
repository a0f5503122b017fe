# SPDX-License-Identifier: BSD-3-Clause
"""Fills a recording from the topics of a running simulation."""

from __future__ import annotations

import time

import rospy
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float32
from tf2_msgs.msg import TFMessage

from bubblesim.geometry.rotations import heading_of
from bubblesim.running.recording import Pose, Recording, Sample


class Observer:
    """Subscribes to /clock, /tf and /front_sonar. The robot is the first frame on /tf."""

    def __init__(self, recording: Recording) -> None:
        """Initialise the ROS node of this process."""
        self._recording = recording
        self._sim_time: float | None = None
        self._frames: tuple[str, str] | None = None
        rospy.init_node("bubblesim_observer", anonymous=True, disable_signals=True)
        self._stamps_are_simulated = bool(rospy.get_param("/use_sim_time", False))
        self._subscribers = [
            rospy.Subscriber("/clock", Clock, self._on_clock),
            rospy.Subscriber("/tf", TFMessage, self._on_tf),
            rospy.Subscriber("/front_sonar", Float32, self._on_sonar),
        ]

    def is_connected(self) -> bool:
        """Return whether the simulator sends what it publishes of these topics."""
        published = {topic for topic, _type in rospy.get_published_topics()}
        return all(each.get_num_connections() > 0 for each in self._subscribers if each.name in published)

    def sees_a_robot(self) -> bool:
        """Return whether somebody publishes /tf."""
        return any(each.name == "/tf" and each.get_num_connections() > 0 for each in self._subscribers)

    def _on_clock(self, message: Clock) -> None:
        self._sim_time = message.clock.to_sec()

    def _on_sonar(self, message: Float32) -> None:
        self._recording.add_sonar(message.data)

    def _on_tf(self, message: TFMessage) -> None:
        for transform in message.transforms:
            frames = (transform.header.frame_id, transform.child_frame_id)
            self._frames = self._frames or frames
            sim_time = transform.header.stamp.to_sec() if self._stamps_are_simulated else self._sim_time
            if frames == self._frames and sim_time is not None:
                place, turn = transform.transform.translation, transform.transform.rotation
                pose = Pose(place.x, place.y, place.z, heading_of(turn.x, turn.y, turn.z, turn.w))
                self._recording.samples.append(Sample(time.monotonic(), sim_time, pose))

    def close(self) -> None:
        """Unregister from the master before it ends."""
        rospy.signal_shutdown("the run is over")
