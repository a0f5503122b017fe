# SPDX-License-Identifier: BSD-3-Clause
"""joint_state_controller, and the controllers of single joints and groups that take commands as numbers."""

from __future__ import annotations

from bubblesim._core.control import ForwardCommand, PidController, PidKind
from bubblesim.gazebo_plugins.control.controller import Controller, Robot, read_gains
from bubblesim.gazebo_plugins.control.ros_parameters import ControllerParameters
from bubblesim.gazebo_plugins.plugin import Message

_PIDS = {"position": PidKind.POSITION, "velocity": PidKind.VELOCITY}


class JointStateController(Controller):
    """joint_state_controller/JointStateController: publishes joint_states in the namespace of the manager."""

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """Read the parameters."""
        super().__init__(robot, name, parameters)
        self._rate = self.rate("publish_rate", None)
        self._names = sorted(robot.joints)
        extra = parameters.dictionaries("extra_joints")
        self._extra = [
            (each.text("name"), *(each.number(key, 0.0) for key in ("position", "velocity", "effort")))
            for each in extra
        ]
        self._publisher = self.advertise(f"{robot.namespace.rstrip('/')}/joint_states", "sensor_msgs/JointState")

    def reset(self) -> None:
        """Reset the rate."""
        self._rate.reset()

    def publish(self) -> None:
        """Publish the states of all joints with a transmission, in the order of their names."""
        if not self._rate.due() or not self.is_needed(self._publisher):
            return
        columns = self.robot.manager.joint_states()
        order = [self.robot.joints[name].index for name in self._names]
        position, velocity, effort = ([column[index] for index in order] for column in columns)
        for _, *values in self._extra:
            for column, value in zip((position, velocity, effort), values, strict=True):
                column.append(value)
        self.send(
            self._publisher,
            {
                "header": {"stamp": self.robot.stamp()},
                "name": [*self._names, *(each[0] for each in self._extra)],
                "position": position,
                "velocity": velocity,
                "effort": effort,
            },
        )


class ForwardController(Controller):
    """A joint controller that passes commands on: std_msgs/Float64 on the topic command."""

    kind = "effort"

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """Read the parameter joint."""
        super().__init__(robot, name, parameters)
        self.core = ForwardCommand(robot.manager, self.claim(self.kind, [parameters.text("joint")]))
        self.subscribe("command", "std_msgs/Float64", lambda message: self.core.set_commands([message["data"]]))


class ForwardGroupController(Controller):
    """A group controller that passes commands on: std_msgs/Float64MultiArray on the topic command."""

    kind = "effort"

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """Read the parameter joints."""
        super().__init__(robot, name, parameters)
        self.core = ForwardCommand(robot.manager, self.claim(self.kind, parameters.names("joints")))
        self.subscribe(
            "command", "std_msgs/Float64MultiArray", lambda message: self.core.set_commands(list(message["data"]))
        )


class PidJointController(Controller):
    """JointPositionController and JointVelocityController with a PID: topics command and state."""

    kind = "effort"  # what is commanded
    controls = "position"

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """Read the parameters joint and pid."""
        super().__init__(robot, name, parameters)
        self._gains = read_gains(parameters.below("pid"))
        (index,) = self.claim(self.kind, [parameters.text("joint")])
        self.core = PidController(robot.manager, index, _PIDS[self.controls], self._gains)
        self.subscribe("command", "std_msgs/Float64", lambda message: self.core.set_command(message["data"]))
        self._publisher = self.advertise(self.topic("state"), "control_msgs/JointControllerState")

    def publish(self) -> None:
        """Publish the state of the last substep."""
        if not self.is_needed(self._publisher):
            return
        set_point, value, rate, error, command = self.core.state()
        gains = self._gains
        message: Message = {
            "header": {"stamp": self.robot.stamp()},
            "set_point": set_point,
            "process_value": value,
            "process_value_dot": rate,
            "error": error,
            "time_step": self.robot.plugin.simulation.substep,
            "command": command,
            "p": gains.p,
            "i": gains.i,
            "d": gains.d,
            "i_clamp": gains.i_max,
            "antiwindup": gains.antiwindup,
        }
        self.send(self._publisher, message)


class PidGroupController(Controller):
    """effort_controllers/JointGroupPositionController: a PID of each joint, with the gains JOINT/pid."""

    kind = "effort"

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """Read the parameter joints, and the gains."""
        super().__init__(robot, name, parameters)
        joints = parameters.names("joints")
        indices = self.claim(self.kind, joints)
        gains = [read_gains(parameters.below(joint, "pid")) for joint in joints]
        self._controllers = [
            PidController(robot.manager, index, PidKind.POSITION, each)
            for index, each in zip(indices, gains, strict=True)
        ]
        self.subscribe("command", "std_msgs/Float64MultiArray", self._on_command)

    def start(self) -> None:
        """Start the controllers of all joints."""
        super().start()
        for controller in self._controllers:
            controller.start(self.robot.manager)

    def stop(self) -> None:
        """Stop them."""
        for controller in self._controllers:
            controller.stop(self.robot.manager)
        super().stop()

    def _on_command(self, message: Message) -> None:
        if len(message["data"]) != len(self._controllers):
            raise ValueError(f"expected {len(self._controllers)} numbers, found {len(message['data'])}")
        for controller, command in zip(self._controllers, message["data"], strict=True):
            controller.set_command(command)


def of_kind(base: type[Controller], kind: str, controls: str = "position") -> type[Controller]:
    """Return the class of controllers that command by an interface, "position", "velocity" or "effort"."""
    return type(
        f"{kind.capitalize()}{base.__name__}", (base,), {"kind": kind, "controls": controls, "__doc__": base.__doc__}
    )
