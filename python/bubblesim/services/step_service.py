# SPDX-License-Identifier: BSD-3-Clause
"""The service ~step."""

from __future__ import annotations

from typing import Any

from bubblesim import _core
from bubblesim.observers.lock_step import LockStep
from bubblesim.scripting.host import interruption


def advertise_step_service(bridge: Any, simulation: Any, lock_step: LockStep | None) -> None:
    """Advertise it in the node's namespace; it responds when the steps are complete. Input is processed in each step.

    :param lock_step: observer that the steps wait for, if any.
    """

    def answer(request: dict[str, Any]) -> dict[str, Any]:
        problem = _step(simulation, request["steps"], lock_step)
        return {"success": not problem, "status_message": problem, "time": simulation.time}

    bridge.advertise_service("~step", "bubblesim_msgs/Step", answer, _core.messages.TimeForm.FLOAT)


def _step(simulation: Any, steps: int, lock_step: LockStep | None) -> str:
    """Run the steps; return the reason of a failure, or an empty string."""
    if simulation.state == _core.RunState.STOPPED:
        return "the simulation is stopped: start it first, with ~unpause"
    if simulation.state != _core.RunState.PAUSED:
        return "the simulation is running by itself: pause it first, with ~pause"
    if interruption.allowed:
        return "the simulation is already being stepped, by another request or by the step that called this script"
    try:
        interruption.allowed = True  # allows interruption of requests with many steps
        for done in range(steps):
            if done and simulation.has_requests:
                return f"interrupted after {done} steps by a request to start, pause or stop"
            if lock_step and (problem := lock_step.wait()):
                return problem
            simulation.step()
    except KeyboardInterrupt:
        return "the simulator is ending"
    except RuntimeError as error:  # diverged
        return str(error)
    finally:
        interruption.allowed = False
    return ""
