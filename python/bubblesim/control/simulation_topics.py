# SPDX-License-Identifier: BSD-3-Clause
"""The topics by which CoppeliaSim's helper for ROS starts, pauses and stops a simulation."""

from __future__ import annotations

from typing import Any

from bubblesim import _core


def listen_to_simulation_topics(bridge: Any, simulation: Any) -> None:
    """Hear std_msgs/Bool on each of them; a message asks, whatever it holds."""
    for topic, action in (
        ("/startSimulation", simulation.start),
        ("/pauseSimulation", simulation.pause),
        ("/stopSimulation", simulation.stop),
    ):
        bridge.subscribe(topic, "std_msgs/Bool", lambda message, do=action: do(), 10, _core.messages.TimeForm.FLOAT)
