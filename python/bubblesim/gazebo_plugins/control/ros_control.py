# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_control and gz_ros2_control: joints with a <transmission> or in a <ros2_control>, their controllers."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from bubblesim._core import control
from bubblesim.gazebo_plugins.control.controller import INTERFACES, Joint, Robot, read_gains
from bubblesim.gazebo_plugins.control.controller_manager import ControllerManager
from bubblesim.gazebo_plugins.control.ros_parameters import ControllerParameters, read_parameter
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.messages.names import did_you_mean, nearest_names
from bubblesim.program.output import write_line

_KINDS = {
    "EffortJointInterface": "effort",
    "PositionJointInterface": "position",
    "PosVelJointInterface": "position",
    "PosVelAccJointInterface": "position",
    "VelocityJointInterface": "velocity",
}
_GAINS = "gazebo_ros_control/pid_gains"


_ONLY_STATES = "ros2_control"  # the type of transmissions whose joints may have no command interface


class RosControl(Plugin):
    """The controllers run before each physics substep; <controlPeriod> has no effect."""

    ignored: Sequence[str] = ("controlPeriod", "robotParam", "robotSimType", "legacyModeNS", "eStopTopic")
    in_namespace_of_model = True

    def __init__(self, context: PluginContext) -> None:
        """Read the transmissions of the model, and advertise the services of the controller manager."""
        super().__init__(context)
        p = self.parameters
        p.ignore(*self.ignored)
        self.enter_namespace(of_model=self.in_namespace_of_model)
        p.check()
        if not hasattr(self.bridge, "search_parameter"):
            raise p.fail("filename", "needs ROS 1, which has a parameter server")
        namespace = f"/{self.namespace}"
        self._joints = joints = self._read_joints()
        if not joints:
            write_line(sys.stderr, f"warning: {p.title}: the model has no <transmission> of a joint")
        gains = self._gains(namespace)
        entries = [
            (name, joint.handle, INTERFACES[joint.kinds[0] if joint.kinds else "effort"], gains.get(name))
            for name, joint in joints.items()
        ]
        self._place()
        manager = control.ControllerManager(self.world, context.model, entries)
        context.endpoints.append(manager.remove)
        robot = Robot(
            self, manager, joints, namespace, {name: joint.kinds[0] for name, joint in joints.items() if joint.kinds}
        )
        self._controllers = ControllerManager(robot)
        context.endpoints.append(self._controllers.close)

    def publish(self) -> None:
        """Publish what the running controllers publish."""
        self._controllers.publish()

    def reset(self) -> None:
        """Put the joints to their initial positions, and reset the controllers."""
        self._place()
        self._controllers.reset()

    def _place(self) -> None:
        for joint in self._joints.values():
            if joint.initial_position is not None:
                self.world.set_joint_position(joint.handle, joint.initial_position)

    def _read_joints(self) -> dict[str, Joint]:
        """Return the joints of the transmissions; those of <ros2_control> may have states only."""
        handles = {self.world.name(part): part for part in self.parts_of_model() if self.world.kind(part) == "joint"}
        found: dict[str, Joint] = {}
        for transmission, kind, joints, of_actuators in control.transmissions(self.world, self.context.model):
            for name, interfaces, initial_position in joints:
                kinds = [
                    _KINDS[last] for each in interfaces or of_actuators if (last := each.rpartition("/")[2]) in _KINDS
                ]
                problem = None
                if name not in handles:
                    problem = f"the model has no joint '{name}'{did_you_mean(nearest_names(name, sorted(handles)))}"
                elif self.world.joint_axes(handles[name]) != 1:
                    problem = f"the joint '{name}' does not move along one axis"
                elif not kinds and kind != _ONLY_STATES:
                    problem = f"the joint '{name}' has no <hardwareInterface> of {', '.join(_KINDS)}"
                if problem is not None:
                    text = f"warning: {self.parameters.title}: transmission '{transmission}' has no effect: {problem}"
                    write_line(sys.stderr, text)
                    continue
                before = found.get(name)
                index = len(found) if before is None else before.index
                known = [] if before is None else list(before.kinds)
                found[name] = Joint(index, handles[name], list(dict.fromkeys([*known, *kinds])), initial_position)
        return found

    def _gains(self, namespace: str) -> dict[str, control.PidGains]:
        """Return the gains of joints whose positions or velocities are reached by efforts."""
        gains: dict[str, control.PidGains] = {}
        for place in dict.fromkeys((f"{namespace.rstrip('/')}/{_GAINS}", f"/{_GAINS}")):
            parameters = ControllerParameters(place, read_parameter(place))
            for name in parameters.names_given():
                gains.setdefault(name, read_gains(parameters.below(name)))
        return gains


class Ros2Control(RosControl):
    """gz_ros2_control and gazebo_ros2_control, with the services and parameters of ROS 1; <parameters> is ignored."""

    ignored = ("parameters", "controller_manager_name", "hold_joints", "position_proportional_gain", "robot_param",
               "robot_param_node", "ros")  # fmt: skip
    in_namespace_of_model = False
