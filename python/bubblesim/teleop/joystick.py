# SPDX-License-Identifier: BSD-3-Clause
"""Linux joystick events of /dev/input/js*, described in the kernel's Documentation/input/joydev."""

import struct
from dataclasses import dataclass, field

EVENT = struct.Struct("=IhBB")  # ms, value, type, number
BUTTON, AXIS, INITIAL = 0x01, 0x02, 0x80
FULL = 32767


@dataclass
class Joystick:
    """The state of axes and buttons; zero and released before their first event."""

    axes: dict[int, float] = field(default_factory=dict)  # -1 to 1; right and towards the user are positive
    buttons: dict[int, bool] = field(default_factory=dict)
    _rest: bytes = b""

    def feed(self, data: bytes) -> None:
        """Process data read from the device, of any length."""
        data = self._rest + data
        whole = len(data) - len(data) % EVENT.size
        self._rest = data[whole:]
        for _, value, kind, number in EVENT.iter_unpack(data[:whole]):
            if kind & ~INITIAL == AXIS:
                self.axes[number] = max(-1.0, value / FULL)
            elif kind & ~INITIAL == BUTTON:
                self.buttons[number] = value != 0
