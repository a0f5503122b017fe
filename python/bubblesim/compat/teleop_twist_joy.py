# SPDX-License-Identifier: BSD-3-Clause
"""The node teleop_node: converts the state of a joystick on the topic joy to velocities on cmd_vel.

Parameters: ~enable_button (0), ~enable_turbo_button (-1: none), and for linear and angular velocities one number for x
and yaw, or a dictionary: ~axis_linear, ~scale_linear, ~scale_linear_turbo, ~axis_angular, ~scale_angular,
~scale_angular_turbo.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from bubblesim.nodes.run_node import run_node

_PARTS = {"linear": {"x": "x", "y": "y", "z": "z"}, "angular": {"yaw": "z", "pitch": "y", "roll": "x"}}
_FIRST = {"linear": "x", "angular": "yaw"}


class TeleopTwistJoy:
    """Publishes while a button is held, and once zeros afterwards."""

    def __init__(self) -> None:
        """Read the parameters."""
        self._enable = int(rospy.get_param("~enable_button", 0))
        self._turbo = int(rospy.get_param("~enable_turbo_button", -1))
        self._axes = {part: _values(f"~axis_{part}", _FIRST[part], default) for part, default in _DEFAULT_AXES.items()}
        self._scales = {
            turbo: {part: _values(f"~scale_{part}{turbo}", _FIRST[part], 0.5) for part in _PARTS}
            for turbo in ("", "_turbo")
        }
        self._driving = False
        self._publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        rospy.Subscriber("joy", Joy, self._on_joy, queue_size=1)

    def _on_joy(self, message: Any) -> None:
        if _held(message.buttons, self._turbo):
            self._publisher.publish(self._twist(message.axes, "_turbo"))
            self._driving = True
        elif _held(message.buttons, self._enable):
            self._publisher.publish(self._twist(message.axes, ""))
            self._driving = True
        elif self._driving:
            self._publisher.publish(Twist())
            self._driving = False

    def _twist(self, axes: Sequence[float], turbo: str) -> Twist:
        twist = Twist()
        for part, fields in _PARTS.items():
            for name, field in fields.items():
                axis = int(self._axes[part].get(name, -1))
                if 0 <= axis < len(axes):
                    setattr(getattr(twist, part), field, axes[axis] * self._scales[turbo][part].get(name, 0.0))
        return twist


_DEFAULT_AXES = {"linear": 1.0, "angular": 0.0}


def _values(parameter: str, first: str, default: float) -> dict[str, float]:
    given = rospy.get_param(parameter, default)
    return (
        {str(name): float(value) for name, value in given.items()} if isinstance(given, dict) else {first: float(given)}
    )


def _held(buttons: Sequence[int], button: int) -> bool:
    return 0 <= button < len(buttons) and bool(buttons[button])


def main() -> int:
    """Run the node until shutdown; return 2 for invalid parameters."""
    return run_node("teleop_twist_joy", __doc__, TeleopTwistJoy)
