# SPDX-License-Identifier: BSD-3-Clause
"""The node joy_node: publishes the state of a joystick on the topic joy.

Parameters: ~dev (/dev/input/js0), ~deadzone (0.05), ~autorepeat_rate (Hz; 0: with changes only), ~coalesce_interval
(accepted without an effect).
"""

from __future__ import annotations

import os
import select
import time
from pathlib import Path

import rospy
from sensor_msgs.msg import Joy

from bubblesim.nodes.run_node import run_node
from bubblesim.teleop.joystick import Joystick

_RETRY = 1.0  # s


class JoyNode:
    """Reads the joystick while it is connected."""

    def __init__(self) -> None:
        """Read the parameters."""
        self._device = Path(str(rospy.get_param("~dev", "/dev/input/js0")))
        self._dead_zone = float(rospy.get_param("~deadzone", 0.05))
        rate = float(rospy.get_param("~autorepeat_rate", 0.0))
        if not 0.0 <= self._dead_zone < 1.0 or rate < 0.0:
            raise ValueError("~deadzone must be from 0 to below 1, ~autorepeat_rate 0 or more")
        self._period = 1.0 / rate if rate else _RETRY
        self._repeats = rate > 0.0
        self._publisher = rospy.Publisher("joy", Joy, queue_size=1)

    def run(self) -> None:
        """Publish until shutdown."""
        while not rospy.is_shutdown():
            try:
                device = os.open(self._device, os.O_RDONLY | os.O_NONBLOCK)
            except OSError as error:
                rospy.loginfo_once(f"waiting for a joystick: {error}")
                time.sleep(_RETRY)
                continue
            try:
                self._follow(device)
            finally:
                os.close(device)

    def _follow(self, device: int) -> None:
        joystick = Joystick()
        while not rospy.is_shutdown():
            changed = bool(select.select([device], [], [], self._period)[0])
            if changed:
                try:
                    data = os.read(device, 4096)
                except OSError:
                    data = b""
                if not data:
                    return  # it was unplugged
                joystick.feed(data)
            if changed or self._repeats:
                self._publisher.publish(self._message(joystick))

    def _message(self, joystick: Joystick) -> Joy:
        message = Joy()
        message.header.stamp = rospy.Time.now()
        axes = range(max(joystick.axes, default=-1) + 1)
        message.axes = [self._axis(joystick.axes.get(axis, 0.0)) for axis in axes]
        buttons = range(max(joystick.buttons, default=-1) + 1)
        message.buttons = [int(joystick.buttons.get(button, False)) for button in buttons]
        return message

    def _axis(self, value: float) -> float:
        """Return the deflection as in ROS, left and up positive, 0 in the dead zone and 1 at the end."""
        beyond = max(0.0, abs(value) - self._dead_zone) / (1.0 - self._dead_zone)
        return -beyond if value > 0 else beyond


def main() -> int:
    """Run the node until shutdown; return 2 for invalid parameters."""
    return run_node("joy_node", __doc__, JoyNode, JoyNode.run)
