# SPDX-License-Identifier: BSD-3-Clause
"""The service ~step."""

from __future__ import annotations

from typing import Any

from bubblesim import _core
from bubblesim.observers.lock_step import LockStep
from bubblesim.scripting.host import interruption


def offer_step_service(bridge: Any, simulation: Any, lock_step: LockStep | None) -> None:
    """Offer it under the node's name; it answers when the steps are done. In each, messages come and go as ever.

    :param lock_step: what the steps wait for, if anything.
    """

    def answer(request: dict[str, Any]) -> dict[str, Any]:
        problem = _step(simulation, request["steps"], lock_step)
        return {"success": not problem, "status_message": problem, "time": simulation.time}

    bridge.advertise_service("~step", "bubblesim_msgs/Step", answer, _core.messages.TimeForm.FLOAT)


def _step(simulation: Any, steps: int, lock_step: LockStep | None) -> str:
    """Run the steps; what kept them from being run, or nothing."""
    if simulation.state == _core.RunState.STOPPED:
        return "the simulation is stopped: start it first, with ~unpause"
    if simulation.state != _core.RunState.PAUSED:
        return "the simulation is running by itself: pause it first, with ~pause"
    if interruption.allowed:
        return "the simulation is being stepped already, by another request or around the script that asks"
    try:
        interruption.allowed = True  # so that a request for many steps does not keep the simulator from ending
        for done in range(steps):
            if done and simulation.has_requests:
                return f"broken off after {done} steps by a request to start, pause or stop"
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
