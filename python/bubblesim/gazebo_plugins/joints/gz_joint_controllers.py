# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's JointController, JointPositionController and ApplyJointForce: a joint commanded by a std_msgs/Float64."""

from __future__ import annotations

from bubblesim._core import MotorMode
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext


class GzJointController(Plugin):
    """Velocity control, rad/s or m/s, by the joint's motor; controller gains are ignored."""

    mode = MotorMode.VELOCITY
    initial = "initial_velocity"
    command_topic = "cmd_vel"

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self._joint = self.joint("joint_name", "")
        self._first = p.number(self.initial, 0.0) if self.initial else 0.0
        p.ignore("use_force_commands", "use_velocity_commands", "use_actuator_msg", "actuator_number")
        p.ignore(*(f"{gain}_gain" for gain in "pid"), "i_max", "i_min", "cmd_max", "cmd_min", "cmd_offset")
        default = f"/model/{self.world.name(context.model)}/joint/{self.world.name(self._joint)}/{self.default_topic()}"
        topic = p.text("topic", p.text("sub_topic", default))
        p.check()
        self._target = self._first
        self.subscribe(topic, "std_msgs/Float64", self._command)

    def default_topic(self) -> str:
        """Return the last part of the default topic, after the joint."""
        return self.command_topic

    def _command(self, message: Message) -> None:
        if self.usable("command", (message["data"],)):
            self._target = message["data"]

    def reset(self) -> None:
        """Return to the initial command."""
        self._target = self._first
        self.world.set_motor_mode(self._joint, self.mode)

    def actuate(self) -> None:
        """Command the joint."""
        self.world.set_target_velocity(self._joint, self._target)


class GzJointPositionController(GzJointController):
    """Position control, rad or m."""

    mode = MotorMode.POSITION
    initial = "initial_position"
    command_topic = "cmd_pos"

    def default_topic(self) -> str:
        """Return the last part of the default topic, with the index of the axis."""
        index = int(self.parameters.number("joint_index", 0.0, least=0.0))
        return f"{index}/{self.command_topic}"

    def actuate(self) -> None:
        """Command the joint."""
        self.world.set_target_position(self._joint, self._target)


class GzApplyJointForce(GzJointController):
    """Force or torque, N or N m, within the limit of the joint's motor."""

    mode = MotorMode.EFFORT
    initial = ""
    command_topic = "cmd_force"

    def actuate(self) -> None:
        """Command the joint."""
        self.world.set_target_effort(self._joint, self._target)
