# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that send messages to other scripts."""

from __future__ import annotations

import math
from typing import Any

from bubblesim.geometry import poses
from bubblesim.scene_state.wireless import WirelessMessage
from bubblesim.scripting.api.kinds import StringOrNothing, TextOrBytes
from bubblesim.scripting.api.sim.context import ApiContext

_TOLERANCE = 1e-6  # of a step


class MessageFunctions(ApiContext):
    """A message reaches all scripts that have the callback sysCall_msg; data of sendData reach those that ask for
    them."""

    def broadcastMsg(self, message: Any, options: int = 0) -> None:
        """Call sysCall_msg(message, origin) of all scripts; ``message`` is a table with ``id`` and ``data``, ``origin``
        the handle of the sending script."""
        if self._caller.shared.scripts is not None:
            self._caller.shared.scripts.broadcast(message, self._caller.object_handle)

    def sendData(
        self,
        target: int,
        header: int,
        name: str,
        data: TextOrBytes,
        antenna: int = -4,
        radius: float = 100.0,
        vertical_angle: float = math.pi,
        horizontal_angle: float = math.tau,
        persistence: float = 0.0,
    ) -> int:
        """Send a string to a script, or with sim.handle_all, handle_tree or handle_chain to all, those below or those
        above; return 1 (old scripts).

        It reaches antennas, objects, within a ``radius`` (m) of the ``antenna``, and within half of the angles (rad) of
        its x axis. It can be received for ``persistence`` s, at least until the end of the next step."""
        own = self._caller.object_handle
        sender = self._resolve(antenna) if antenna != self.handle_self or own >= 0 else -1
        goal = target if target in (self.handle_all, self.handle_tree, self.handle_chain) else self._resolve(target)

        def is_for(receiver: int, at: int) -> bool:
            if goal == self.handle_tree and not self._is_under(receiver, own):
                return False
            if goal == self.handle_chain and not self._is_under(own, receiver):
                return False
            if goal >= 0 and receiver != goal:
                return False
            return self._is_in_reach(sender, at, radius, vertical_angle, horizontal_angle)

        now, step = float(self._simulation.time), float(self._simulation.time_step)
        until = now + max(persistence, step) + step * (1 - _TOLERANCE)
        self._caller.shared.wireless.send(WirelessMessage(own, header, name, data, is_for, until), now)
        return 1

    def receiveData(
        self, header: int = -1, name: StringOrNothing = None, antenna: int = -4, index: int = -1
    ) -> tuple[str | bytes | None, int, int, str]:
        """Return the oldest data with a header (-1: any) and a name (nil: any) that have reached the antenna, the
        handle of the sender, header and name; None (nil) if there are none (old scripts). With an ``index`` from 0, the
        data stay."""
        own = self._caller.object_handle
        at = self._resolve(antenna) if antenna != self.handle_self or own >= 0 else -1
        waiting = self._caller.shared.wireless.waiting(float(self._simulation.time), own, at)
        found = [each for each in waiting if header in (-1, each.header) and name in (None, "", each.name)]
        if not 0 <= max(index, 0) < len(found):
            return None, -1, -1, ""
        message = found[max(index, 0)]
        if index < 0:
            message.received.add(own)
        return message.data, message.sender, message.header, message.name

    def _is_under(self, handle: int, above: int) -> bool:
        while handle >= 0 and (handle := self._tree.parent(handle)) >= 0:
            if handle == above:
                return True
        return above < 0

    def _is_in_reach(self, sender: int, receiver: int, radius: float, vertical: float, horizontal: float) -> bool:
        if sender < 0 or receiver < 0 or not (self._tree.contains(sender) and self._tree.contains(receiver)):
            return True
        x, y, z = poses.transform(poses.inverse(self._tree.pose(sender)), self._tree.pose(receiver)[:3])
        if math.hypot(x, y, z) > radius:
            return False
        return abs(math.atan2(z, math.hypot(x, y))) <= vertical / 2 and abs(math.atan2(y, x)) <= horizontal / 2
