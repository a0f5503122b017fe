# SPDX-License-Identifier: BSD-3-Clause
"""What the callbacks of a sensor's script get: sysCall_vision and sysCall_trigger."""

from __future__ import annotations

from typing import Any

from bubblesim import _core
from bubblesim.scene_state.shared_data import SharedData


def kind_of(simulation: Any, handle: int) -> str:
    """Return the kind of a sensor; an empty string for another object."""
    is_sensor = handle >= 0 and str(simulation.world.kind(handle)) == "sensor"
    return str(_core.sensor_kind(simulation, handle)) if is_sensor else ""


def image_data(simulation: Any, handle: int) -> dict[str, Any] | None:
    """Return the argument of sysCall_vision; None if the object is not a camera."""
    if kind_of(simulation, handle) != "camera":
        return None
    image = _core.read_camera(simulation, handle)
    columns, rows, angle = _core.camera_optics(simulation, handle)
    return {
        "handle": handle,
        "resolution": [columns, rows],
        "clippingPlanes": [image.near, image.far],
        "viewAngle": angle,
        "orthoSize": 0.0,
        "perspectiveOperation": True,
    }


def keep_vision_result(shared: SharedData, handle: int, result: Any) -> None:
    """Keep what readVisionSensor returns from the result of sysCall_vision."""
    if isinstance(result, dict):
        packets = result.get("packedPackets")
        shared.vision_results[handle] = (
            bool(result.get("trigger")),
            list(packets) if isinstance(packets, list | tuple) else [],
        )


def trigger_data(simulation: Any, handle: int, shared: SharedData) -> dict[str, Any] | None:
    """Return the argument of sysCall_trigger; None if the sensor has not triggered.

    A proximity sensor triggers when it detects something, a camera when its sysCall_vision returns that. A force sensor
    triggers in the original above a threshold, which files do not bring over: here it does not.
    """
    kind = kind_of(simulation, handle)
    if kind == "camera":
        triggered, packets = shared.vision_results.get(handle, (False, []))
        return {"handle": handle, "packedPackets": packets} if triggered else None
    if kind != "proximity sensor":
        return None
    result, _, point, detected, normal = _core.read_proximity(simulation, handle)
    if not result:
        return None
    model = int(simulation.world.outermost_model_of(detected))
    if model in shared.edits.shapes:
        detected = shared.edits.known_handle(model)
    return {
        "handle": handle,
        "detectedObjectHandle": detected,
        "detectedPoint": point,
        "normalVector": normal,
        "detectedObject": detected,  # names of older versions
    }


def keep_trigger_result(shared: SharedData, handle: int, result: Any) -> None:
    """Let a camera not trigger, or trigger, as sysCall_trigger returned."""
    if isinstance(result, dict) and "trigger" in result and handle in shared.vision_results:
        shared.vision_results[handle] = (bool(result["trigger"]), shared.vision_results[handle][1])
