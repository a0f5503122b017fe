#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Teleoperation with a joystick: Twist on cmd_vel. The robot stops while the joystick is unplugged.

Parameters: ~dev (/dev/input/js0), ~speed (m/s) and ~turn (rad/s) at full deflection, ~axis_linear (1), ~axis_angular
(0), ~enable_button (must be held; -1: none), ~dead_zone, ~rate (Hz), ~stamped, ~frame_id.
"""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while modules are loaded shows no traceback

import os
import select
import sys
import time
from pathlib import Path

import rospy

from bubblesim.controllers.base_velocity import STANDING, BaseVelocity
from bubblesim.nodes.run_node import run_node, run_ros_program
from bubblesim.nodes.twist_commands import TwistCommands
from bubblesim.teleop.joystick import Joystick
from bubblesim.teleop.stick_teleop import StickTeleop


class JoyTeleop:
    """Reads the joystick while it is connected."""

    def __init__(self) -> None:
        """Read the parameters; the node must be initialised."""
        self._device = Path(str(rospy.get_param("~dev", "/dev/input/js0")))
        self._linear = int(rospy.get_param("~axis_linear", 1))
        self._angular = int(rospy.get_param("~axis_angular", 0))
        self._enable = int(rospy.get_param("~enable_button", -1))
        self._period = 1.0 / float(rospy.get_param("~rate", 10.0))
        self._teleop = StickTeleop(
            speed=float(rospy.get_param("~speed", 0.5)),
            turn=float(rospy.get_param("~turn", 1.0)),
            dead_zone=float(rospy.get_param("~dead_zone", 0.1)),
        )
        self._commands = TwistCommands()

    def run(self) -> None:
        """Drive while a joystick is connected, wait for it otherwise, until shutdown."""
        while not rospy.is_shutdown():
            try:
                device = os.open(self._device, os.O_RDONLY | os.O_NONBLOCK)
            except OSError as error:
                present = ", ".join(map(str, sorted(Path("/dev/input").glob("js*")))) or "none"
                rospy.logwarn_throttle(30.0, f"waiting for a joystick: {error}; available: {present}")
                time.sleep(self._period)
                continue
            try:
                self._drive(device)
            finally:
                os.close(device)
                self._commands.follow(STANDING)
            time.sleep(self._period)

    def _drive(self, device: int) -> None:
        """Drive until the joystick is unplugged."""
        rospy.loginfo(f"driving with {self._device}")
        joystick = Joystick()
        while not rospy.is_shutdown():
            until = time.monotonic() + self._period
            while (left := until - time.monotonic()) > 0 and select.select([device], [], [], left)[0]:
                try:
                    data = os.read(device, 4096)
                except OSError:
                    data = b""
                if not data:
                    rospy.logwarn(f"{self._device} was unplugged")
                    return
                joystick.feed(data)
            self._commands.follow(self._velocity(joystick))

    def _velocity(self, joystick: Joystick) -> BaseVelocity:
        if self._enable >= 0 and not joystick.buttons.get(self._enable, False):
            return STANDING
        forward, left = -joystick.axes.get(self._linear, 0.0), -joystick.axes.get(self._angular, 0.0)
        return self._teleop.velocity(forward, left)


def main() -> int:
    """Run the node until shutdown; return 2 for invalid parameters."""
    return run_node("joy_teleop", __doc__, JoyTeleop, JoyTeleop.run)


if __name__ == "__main__":
    sys.exit(run_ros_program(main))
