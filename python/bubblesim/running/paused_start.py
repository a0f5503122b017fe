# SPDX-License-Identifier: BSD-3-Clause
"""The start of a simulation that is observed from its beginning."""

from __future__ import annotations

import contextlib
import time

import rosgraph
import rospy
from bubblesim_msgs.srv import Step
from std_srvs.srv import Empty

from bubblesim.program.simulators import simulators
from bubblesim.running.observer import Observer

_ADVERTISING = 0.5  # s after the first step, until the master knows its topics
_ADVERTISING_AT_MOST = 5.0  # s, on a busy machine; if /tf is still not there, no robot is published


class PausedStart:
    """Lets a paused simulation run once an observer receives what it publishes.

    Scripts create their topics in the first step, so it runs alone. A short run at full speed would be over before the
    observer is connected.
    """

    def __init__(self, observer: Observer) -> None:
        """Begin with advance()."""
        self._observer = observer
        self._simulator: str | None = None
        self._stepped_at: float | None = None
        self._is_done = False

    def advance(self) -> None:
        """Do what is possible now, without waiting for the simulator; it may end meanwhile."""
        if self._is_done:
            return
        with contextlib.suppress(OSError, rospy.ROSException, rospy.ServiceException, rosgraph.MasterException):
            self._advance()

    def _advance(self) -> None:
        if self._simulator is None:
            self._simulator = next(iter(simulators(rosgraph.Master(rospy.get_name()).getSystemState())), None)
        elif self._stepped_at is None:
            rospy.ServiceProxy(f"{self._simulator}/step", Step)(1)
            self._stepped_at = time.monotonic()
        elif self._observer.is_connected() and self._is_advertised(time.monotonic() - self._stepped_at):
            rospy.ServiceProxy(f"{self._simulator}/unpause", Empty)()
            self._is_done = True

    def _is_advertised(self, waited: float) -> bool:
        """Return whether the master should know the topics of the scene by now."""
        return waited > (_ADVERTISING if self._observer.sees_a_robot() else _ADVERTISING_AT_MOST)
