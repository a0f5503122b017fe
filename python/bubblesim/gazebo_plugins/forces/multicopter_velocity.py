# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's MulticopterVelocityControl: a multicopter that follows a Twist."""

from __future__ import annotations

from typing import Any

from bubblesim._core import MulticopterVelocityControl
from bubblesim.gazebo_plugins.plugin import FASTEST, Message, Plugin, PluginContext


class MulticopterVelocity(Plugin):
    """Parameters, topics and defaults are those of gz-sim. The constants of the rotors are those of their motors."""

    acts_without_ros = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace(of_model=True)
        self._link = self.link("comLinkName", "")
        rotors = p.inner("rotorConfiguration").all_of("rotor")
        self._joints = [self.joint_named(rotor.text("jointName", ""), "rotorConfiguration") for rotor in rotors]
        for name in ("velocityGain", "attitudeGain", "angularRateGain"):
            if p.given(name) is None:
                raise p.fail(name, "is missing, it must be 3 numbers")
        zero, unlimited = (0.0, 0.0, 0.0), (FASTEST, FASTEST, FASTEST)
        self._gains = {
            "velocity_gain": p.numbers("velocityGain", zero),
            "attitude_gain": p.numbers("attitudeGain", zero),
            "rate_gain": p.numbers("angularRateGain", zero),
            "max_acceleration": p.numbers("maximumLinearAcceleration", unlimited),
        }
        self._fastest = *p.numbers("maximumLinearVelocity", unlimited), *p.numbers("maximumAngularVelocity", unlimited)
        p.ignore("linearVelocityNoiseMean", "linearVelocityNoiseStdDev")
        p.ignore("angularVelocityNoiseMean", "angularVelocityNoiseStdDev")
        command, enable = p.text("commandSubTopic", "cmd_vel"), p.text("enableSubTopic", "enable")
        p.check()
        self._enabled = True
        self._control: Any = None  # made with the first command: the motors may come after this plugin
        self.subscribe(command, "geometry_msgs/Twist", self._command)
        self.subscribe(enable, "std_msgs/Bool", self._enable)

    def fly(self, linear: tuple[float, float, float], yaw_rate: float) -> None:
        """Fly at a velocity along the axes of the link, m/s, and a yaw rate, rad/s."""
        if self._control is None:
            missing = [self.world.name(joint) for joint in self._joints if joint not in self.context.actuators]
            if missing:
                raise self.parameters.fail("rotorConfiguration", f"has joints without a motor: {', '.join(missing)}")
            rotors = [self.context.actuators[joint] for joint in self._joints]
            self._control = MulticopterVelocityControl(self.simulation, self._link, rotors, **self._gains)
            self.context.endpoints.append(self._control.remove)
        self._control.set_velocity(linear, yaw_rate)

    def _command(self, twist: Message) -> None:
        linear, angular = twist["linear"], twist["angular"]
        given = linear["x"], linear["y"], linear["z"], angular["x"], angular["y"], angular["z"]
        if self._enabled and self.usable("Twist", given):
            x, y, z, _, _, yaw_rate = (
                min(max(value, -abs(most)), abs(most)) for value, most in zip(given, self._fastest, strict=True)
            )
            self.fly((x, y, z), yaw_rate)

    def _enable(self, message: Message) -> None:
        self._enabled = message["data"]
        if not self._enabled and self._control is not None:
            self._control.stop()
