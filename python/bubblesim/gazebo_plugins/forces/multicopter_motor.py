# SPDX-License-Identifier: BSD-3-Clause
"""The multicopter motor model of gz-sim and of RotorS: the thrust of a propeller."""

from __future__ import annotations

import sys

from bubblesim._core import Rotor
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext
from bubblesim.program.output import write_line


class MulticopterMotor(Plugin):
    """Parameters and defaults are those of gz-sim and RotorS; commands are mav_msgs/Actuators, as in RotorS."""

    acts_without_ros = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace(of_model=True)
        self._joint = self.joint("jointName", "")
        p.ignore("linkName", "motorType", "actuator_number")
        if p.given("turningDirection") is None:
            raise p.fail("turningDirection", "is missing, it must be cw or ccw")
        p.choice("motorType", "velocity", {"velocity": None})
        clockwise = p.choice("turningDirection", "cw", {"cw": True, "ccw": False})
        number = p.number("motorNumber", 0.0, least=0.0)
        if not number.is_integer():
            raise p.fail("motorNumber", f"is '{number:g}', it must be a whole number")
        self._number = int(number)
        numbers = {
            "max_speed": p.length("maxRotVelocity", 838.0),
            "thrust_coefficient": p.number("motorConstant", 8.54858e-06, least=0.0),
            "torque_length": p.number("momentConstant", 0.016),
            "drag_coefficient": p.number("rotorDragCoefficient", 1e-4, least=0.0),
            "rolling_coefficient": p.number("rollingMomentCoefficient", 1e-6, least=0.0),
            "time_up": p.number("timeConstantUp", 1 / 80, least=0.0),
            "time_down": p.number("timeConstantDown", 1 / 40, least=0.0),
            "slowdown": p.number("rotorVelocitySlowdownSim", 10.0, least=1.0),
        }
        topic = p.text("commandSubTopic", "command/motor_speed")
        speed_topic = p.given("motorSpeedPubTopic") or p.given("motorVelocityPubTopic")
        p.check()
        self._rotor = Rotor(self.simulation, self._joint, clockwise, **numbers)
        context.endpoints.append(self._rotor.remove)
        context.actuators[self._joint] = self._rotor
        self._short = False
        self._publisher: int | None = None
        self.subscribe(topic, "mav_msgs/Actuators", self._command)
        if speed_topic and self.bridge is not None:
            self._publisher = self.advertise(speed_topic, "std_msgs/Float32", 10)

    def close(self) -> None:
        """Remove the rotor."""
        self.context.actuators.pop(self._joint, None)
        super().close()

    def _command(self, message: Message) -> None:
        speeds = message["angular_velocities"]
        if len(speeds) <= self._number:
            if not self._short:
                text = f"{len(speeds)} angular_velocities ignored: motorNumber is {self._number}"
                write_line(sys.stderr, f"warning: {self.parameters.title}: {text}")
            self._short = True
        elif self.usable("angular velocity", (speeds[self._number],)):
            self._rotor.set_speed(speeds[self._number])

    def publish(self) -> None:
        """Publish the speed of the joint, rad/s, as RotorS does."""
        if self._publisher is not None and self.is_needed(self._publisher):
            self.bridge.publish(self._publisher, {"data": self.world.joint_velocity(self._joint)})
