# SPDX-License-Identifier: BSD-3-Clause
"""What sysCall_joint gets, and what its answer does to the joint."""

from __future__ import annotations

import math
from typing import Any

from bubblesim._core import MotorMode

_DYNAMIC = 5  # sim.jointmode_dynamic
_ACCELERATION, _JERK = 10.0, 50.0  # rad/s^2 or m/s^2 and their rate: files keep no limits of motions
_FASTEST = 1e4  # rad/s or m/s: scripts command the force alone by a velocity that is never reached


def joint_data(world: Any, joint: int) -> dict[str, Any]:
    """Return the argument of sysCall_joint but for the pass; with the names of older versions."""
    lower, upper = world.joint_limits(joint)
    is_cyclic = not math.isfinite(upper - lower)
    is_revolute = world.joint_type(joint) != "prismatic"
    position, target = float(world.joint_position(joint)), float(world.target_position(joint))
    error = target - position
    if is_cyclic and is_revolute:
        error = math.remainder(error, math.tau)
    lower, upper = (-math.pi, math.pi) if is_cyclic else (lower, upper)
    fastest, strongest = _finite(world.max_velocity(joint)), _finite(world.max_force(joint))
    return {
        "mode": _DYNAMIC,
        "handle": joint,
        "joint": joint,
        "revolute": is_revolute,
        "cyclic": is_cyclic,
        "lowLimit": lower,
        "highLimit": upper,
        "bounds": [lower, upper],
        "pos": position,
        "vel": float(world.joint_velocity(joint)),
        "targetPos": target,
        "targetVel": float(world.target_velocity(joint)),
        "error": error,
        "maxVel": fastest,
        "maxAccel": _ACCELERATION,
        "maxJerk": _JERK,
        "effort": float(world.motor_effort(joint)),
        "force": strongest,
        "maxForce": strongest,
        "currentPos": position,
        "errorValue": error,
        "velUpperLimit": fastest,
    }


def drive(world: Any, joint: int, answer: Any) -> bool:
    """Apply the answer, a velocity (rad/s or m/s) and the largest force (N m or N) to reach it; return whether there
    was one."""
    if not isinstance(answer, dict):
        return False
    velocity, force = (answer.get("vel", answer.get("velocity")), answer.get("force"))
    if not isinstance(velocity, int | float) or not isinstance(force, int | float):
        return False
    if math.isnan(velocity) or math.isnan(force):
        return False
    if world.motor_mode(joint) != MotorMode.VELOCITY:
        world.set_motor_mode(joint, MotorMode.VELOCITY)
    world.set_target_velocity(joint, min(max(velocity, -_FASTEST), _FASTEST))
    world.set_max_force(joint, abs(force))
    return True


def _finite(limit: float) -> float:
    return min(float(limit), _FASTEST)
