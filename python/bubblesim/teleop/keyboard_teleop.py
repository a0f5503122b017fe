# SPDX-License-Identifier: BSD-3-Clause
"""Keyboard teleoperation: pressed keys in, velocity out."""

from dataclasses import dataclass

from bubblesim.controllers.base_velocity import BaseVelocity

STEP = 1.1  # of a speed key: ten per cent

# Forward, left and turning left, as fractions of the speeds.
DIRECTIONS = {
    "u": (1, 0, 1), "i": (1, 0, 0), "o": (1, 0, -1),
    "j": (0, 0, 1), "k": (0, 0, 0), "l": (0, 0, -1),
    "m": (-1, 0, -1), ",": (-1, 0, 0), ".": (-1, 0, 1),
    # With shift: holonomic motion.
    "U": (1, 1, 0), "I": (1, 0, 0), "O": (1, -1, 0),
    "J": (0, 1, 0), "K": (0, 0, 0), "L": (0, -1, 0),
    "M": (-1, 1, 0), "<": (-1, 0, 0), ">": (-1, -1, 0),
}  # fmt: skip

# Factors of the linear and the angular speed.
SPEEDS = {
    "q": (STEP, STEP), "z": (1 / STEP, 1 / STEP),
    "w": (STEP, 1.0), "x": (1 / STEP, 1.0),
    "e": (1.0, STEP), "c": (1.0, 1 / STEP),
}  # fmt: skip

HELP = """\
Drive:                    Sideways, with shift:
    u    i    o               U    I    O
    j    k    l               J    K    L
    m    ,    .               M    <    >

q z  faster, slower      w x  the same for driving      e c  the same for turning
Any other key stops. Ctrl-C ends.
"""


@dataclass
class KeyboardTeleop:
    """Keeps the speeds and the time of the last key. Times are in seconds, of any monotonic clock."""

    speed: float = 0.5  # m/s
    turn: float = 1.0  # rad/s
    speed_limit: float = 1000.0
    turn_limit: float = 1000.0
    timeout: float | None = 0.6  # s without a key before it stops; None: never stop

    def __post_init__(self) -> None:
        """Start at rest."""
        self._direction = (0, 0, 0)
        self._pressed_at = 0.0

    def press(self, key: str, now: float) -> bool:
        """Handle a key. Return whether the speeds have changed."""
        self._pressed_at = now
        if key in SPEEDS:
            linear, angular = SPEEDS[key]
            before = self.speed, self.turn
            self.speed = min(self.speed * linear, self.speed_limit)
            self.turn = min(self.turn * angular, self.turn_limit)
            return (self.speed, self.turn) != before
        self._direction = DIRECTIONS.get(key, (0, 0, 0))
        return False

    def velocity(self, now: float) -> BaseVelocity:
        """Return the velocity to drive at."""
        if self.timeout is not None and now - self._pressed_at > self.timeout:
            self._direction = (0, 0, 0)
        forward, left, turning = self._direction
        return BaseVelocity(forward * self.speed, left * self.speed, turning * self.turn)
