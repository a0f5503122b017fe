# SPDX-License-Identifier: BSD-3-Clause
"""The models of sensors that scripts and programs create: a static link, which is the object, with one sensor."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

_VOLUMES = {30: "pyramid", 31: "cylinder", 32: "disc", 33: "cone", 34: "ray"}  # sim.proximitysensor_..._subtype
_WIDEST = 1.5  # rad, half angle of a volume or of a view
_LEAST_NEAR, _LEAST_FAR = 0.001, 0.1  # m, of SDFormat's cameras
_MOST_PIXELS = 4096  # in a row or column


@dataclass(frozen=True)
class CreatedSensor:
    """A sensor as SDFormat."""

    name: str
    """Of the object."""
    element: str
    """The element <sensor>."""
    with_pixels: Callable[[int, int], CreatedSensor] | None = None
    """Of a camera: returns the same one with other columns and rows."""

    def sdf(self) -> str:
        """Return the model; its link has CoppeliaSim's axes: the sensor looks along z."""
        return (
            '<sdf version="1.9" xmlns:bubblesim="https://bubblesim"><model name="' + self.name + '">'
            "<bubblesim:axis_convention>coppeliasim</bubblesim:axis_convention><static>true</static>"
            f'<bubblesim:is_object>false</bubblesim:is_object><link name="link"><bubblesim:alias>{self.name}'
            f"</bubblesim:alias><bubblesim:place><id>1</id></bubblesim:place>{self.element}</link></model></sdf>"
        )


# Sensors look along x with z up in SDFormat, along z with y up here.
_POSE = f"<pose>0 0 0 {-math.pi / 2!r} {-math.pi / 2!r} 0</pose>"


def proximity_sensor(kind: int, floats: Sequence[float]) -> CreatedSensor:
    """Return a proximity sensor.

    :param floats: as of sim.createProximitySensor: offset, range, sizes near x, y and far x, y, gap, radius near and
        far (m), angle, largest angle to the surface (rad), smallest distance (m).
    """
    if kind not in _VOLUMES:
        raise ValueError(f"{kind} is not a proximity sensor: use sim.proximitysensor_pyramid_subtype, cylinder ...")
    if len(floats) < 12:
        raise ValueError(f"a proximity sensor needs 12 numbers or more, found {len(floats)}")
    offset, reach, _, _, far_x, far_y, _, near_radius, far_radius, angle, threshold, smallest = floats[:12]
    volume = _VOLUMES[kind]
    near = near_radius if volume in ("cone", "disc") else offset
    farthest = near + reach
    least = max(smallest, near, 0.0)
    if not least < farthest:
        raise ValueError(f"the range of a proximity sensor must be above its smallest distance, found {reach:g} m")
    half = {
        "cone": angle / 2,
        "disc": angle / 2,
        "pyramid": math.atan2(max(far_x, far_y) / 2, farthest),
        "cylinder": math.atan2(far_radius, farthest),
        "ray": 0.0,
    }[volume]
    radius = farthest * math.tan(min(max(half, 0.0), _WIDEST))
    limit = f"<bubblesim:max_normal_angle>{min(threshold, math.pi)!r}</bubblesim:max_normal_angle>"
    return CreatedSensor(
        "Proximity_sensor",
        f'<sensor name="sensor" type="sonar">{_POSE}<sonar><min>{least!r}</min><max>{farthest!r}</max>'
        f"<radius>{radius!r}</radius><bubblesim:volume>{volume}</bubblesim:volume>{limit if threshold > 0 else ''}"
        "</sonar></sensor>",
    )


def vision_sensor(
    columns: int, rows: int, floats: Sequence[float], rate: float, *, is_perspective: bool
) -> CreatedSensor:
    """Return a camera.

    :param floats: as of sim.createVisionSensor: near and far plane (m), and the angle (rad) or the width (m) of the
        larger side.
    :param rate: images per s.
    """
    if not (0 < columns <= _MOST_PIXELS and 0 < rows <= _MOST_PIXELS):
        raise ValueError(f"a vision sensor has 1 to {_MOST_PIXELS} pixels in each direction, found {columns} x {rows}")
    if len(floats) < 3:
        raise ValueError(f"a vision sensor needs near plane, far plane and angle or width, found {len(floats)} numbers")
    near, far, opening = floats[:3]
    far = max(far, _LEAST_FAR)
    part = min(1.0, columns / rows)
    angle = opening if is_perspective else 1.0
    half = math.atan(part * math.tan(min(max(angle / 2, 0.0), _WIDEST)))
    flat = f"<bubblesim:orthographic_width>{part * opening!r}</bubblesim:orthographic_width>"
    return CreatedSensor(
        "Vision_sensor",
        f'<sensor name="sensor" type="camera">{_POSE}<update_rate>{rate!r}</update_rate><camera><horizontal_fov>'
        f"{2 * min(max(half, 0.005), _WIDEST)!r}</horizontal_fov>{'' if is_perspective else flat}"
        f"<image><width>{columns}</width><height>{rows}</height></image><clip><near>"
        f"{min(max(near, _LEAST_NEAR), far / 2)!r}</near><far>{far!r}</far></clip></camera></sensor>",
        lambda wide, high: vision_sensor(wide, high, floats, rate, is_perspective=is_perspective),
    )
