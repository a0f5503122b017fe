# SPDX-License-Identifier: BSD-3-Clause
"""The plugin mimic_joint of roboticsgroup_gazebo_plugins: a joint that follows another one, such as a second finger."""

from __future__ import annotations

from bubblesim._core import MotorMode
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext


class MimicJoint(Plugin):
    """Parameters and defaults are those of the original, which sets the joint directly; here a motor moves it."""

    acts_without_ros = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self._leader = self.joint("joint", "")
        self._follower = self.joint("mimicJoint", "")
        self._multiplier = p.number("multiplier", 1.0)
        self._offset = p.number("offset", 0.0)
        self._deadband = p.number("sensitiveness", 0.0, least=0.0)
        limit = p.number("maxEffort", 1.0, least=0.0)
        self._max_force = limit if p.given("hasPID") is not None else None
        p.ignore("robotNamespace")
        p.check()

    def reset(self) -> None:
        """Let a motor move the joint."""
        self.world.set_motor_mode(self._follower, MotorMode.VELOCITY)
        if self._max_force is not None:
            self.world.set_max_force(self._follower, self._max_force)

    def actuate(self) -> None:
        """Move to where the leader is at the end of the step, if it goes on as it does."""
        step = self.simulation.time_step
        there = self.world.joint_position(self._leader) + self.world.joint_velocity(self._leader) * step
        deviation = self._multiplier * there + self._offset - self.world.joint_position(self._follower)
        self.world.set_target_velocity(self._follower, deviation / step if abs(deviation) >= self._deadband else 0.0)
