# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_joint_pose_trajectory: joints that follow the points of a trajectory."""

from __future__ import annotations

from bubblesim._core import MotorMode
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext


class JointPoseTrajectory(Plugin):
    """Parameters and defaults are those of gazebo_ros_pkgs. Motors move to the points; Gazebo sets the joints directly.

    Each point is the target from its time on; times are relative to the arrival of the message.
    """

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        p.ignore("serviceName", "updateRate")
        p.check()
        self._joints: list[int] = []
        self._points: list[tuple[float, list[float]]] = []  # simulated time, positions
        self.subscribe(p.text("topicName", "set_joint_trajectory"), "trajectory_msgs/JointTrajectory", self._command)

    def _command(self, trajectory: Message) -> None:
        points = [(point["time_from_start"], list(point["positions"])) for point in trajectory["points"]]
        if not all(self.usable("point", positions) for _, positions in points):
            return
        names = trajectory["joint_names"]
        if any(len(positions) != len(names) for _, positions in points):
            raise ValueError(f"each point must have {len(names)} positions, one per joint")
        joints = [self.world.find(f"{self.world.path(self.context.model)}/{name}") for name in names]
        for joint in joints:
            self.world.set_motor_mode(joint, MotorMode.POSITION)
        start = self.simulation.time
        self._joints = joints
        self._points = sorted((start + after, positions) for after, positions in points)

    def reset(self) -> None:
        """Delete the trajectory."""
        self._points = []

    def actuate(self) -> None:
        """Set the targets of the current point."""
        while self._points and self._points[0][0] <= self.simulation.time:
            _, positions = self._points.pop(0)
            for joint, position in zip(self._joints, positions, strict=True):
                self.world.set_target_position(joint, position)
