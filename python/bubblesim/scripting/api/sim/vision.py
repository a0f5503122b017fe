# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions about what cameras and lidars see."""

from __future__ import annotations

from typing import Any

import numpy as np

from bubblesim._core import camera_optics, measure_camera, override_image, read_camera, read_lidar
from bubblesim.scripting.api.kinds import Bytes, Handle, Integers
from bubblesim.scripting.api.sim.context import ApiContext

Array = np.ndarray[Any, Any]
Packets = tuple[int, list[float]]

_WHOLE: list[int] = [0, 0]
_GREY = 1
_METRES = 1
_FOUR_CHANNELS, _FLIP_X, _FLIP_Y = 1, 2, 4


class VisionFunctions(ApiContext):
    """Images in scripts go from the bottom row up; those that functions give as numpy arrays go from the top down."""

    def getVisionSensorImg(
        self,
        sensor: Handle,
        options: int = 0,
        rgba_cut_off: float = 0.0,
        position: Integers = _WHOLE,
        size: Integers = _WHOLE,
    ) -> tuple[bytes, list[int]]:
        """The picture's bytes and its [width, height].

        Three bytes a pixel, red first; one with options 1 (grey); one more with a cut-off above 0: 255 where the depth,
        0 to 1, is below it. ``position`` and ``size`` choose a part, from the lower left corner, in pixels.
        """
        image = read_camera(self._simulation, self._resolve(sensor))
        pixels = self._picture(image, sensor)
        if options & _GREY:
            pixels = pixels.mean(axis=2).round().astype(np.uint8)[:, :, None]
        if rgba_cut_off > 0:
            below = np.where(_buffer(image) < rgba_cut_off, np.uint8(255), np.uint8(0))
            pixels = np.dstack([pixels, below])
        part = _part(pixels[::-1], position, size)
        return part.tobytes(), [part.shape[1], part.shape[0]]

    def setVisionSensorImg(self, sensor: Handle, image: Bytes) -> None:
        """Show a picture on a camera, three bytes a pixel from the bottom row up, in place of what it sees.

        From now on it is what the functions about images give, until the simulation starts again.
        """
        columns, rows = self.getVisionSensorRes(sensor)
        if len(image) != columns * rows * 3:
            raise ValueError(f"{columns} x {rows} pixels of 3 bytes are not {len(image)} bytes")
        top_down = np.frombuffer(image, np.uint8).reshape(rows, columns, 3)[::-1]
        override_image(self._simulation, self._resolve(sensor), top_down.tobytes())

    def setVisionSensorCharImage(self, sensor: Handle, image: Bytes) -> None:
        """Show a picture on a camera (old style)."""
        self.setVisionSensorImg(sensor, image)

    def getVisionSensorCharImage(
        self, sensor: Handle, x: int = 0, y: int = 0, width: int = 0, height: int = 0
    ) -> tuple[bytes, int, int]:
        """The picture's bytes, width and height (old style)."""
        data, (columns, rows) = self.getVisionSensorImg(sensor, 0, 0.0, [x, y], [width, height])
        return data, columns, rows

    def getVisionSensorDepth(
        self,
        sensor: Handle,
        options: int = 0,
        position: Integers = _WHOLE,
        size: Integers = _WHOLE,
    ) -> tuple[bytes, list[int]]:
        """Depths as packed floats, for sim.unpackFloatTable, and their [width, height].

        From 0 at the near plane to 1 at the far one; with options 1 in metres along the axis.
        """
        image = read_camera(self._simulation, self._resolve(sensor))
        depth = np.clip(image.depth, image.near, image.far) if options & _METRES else _buffer(image)
        part = _part(depth[::-1], position, size)
        return part.astype(np.float32).tobytes(), [part.shape[1], part.shape[0]]

    def getVisionSensorRes(self, sensor: Handle) -> list[int]:
        """[width, height] in pixels."""
        columns, rows, _ = self._optics(sensor)
        return [columns, rows]

    def getVisionSensorFieldOfView(self, sensor: Handle) -> float:
        """Across, in radians."""
        return self._optics(sensor)[2]

    def getVisionSensorArray(self, sensor: Handle) -> Array:
        """The picture as an array of height x width x 3 that is not copied, from the top row down."""
        return self._picture(read_camera(self._simulation, self._resolve(sensor)), sensor)

    def readVisionSensor(self, sensor: Handle) -> Packets:
        """0, and the least, the greatest and the mean of the last picture's intensity, red, green, blue and depth."""
        return 0, _statistics(read_camera(self._simulation, self._resolve(sensor)))

    def handleVisionSensor(self, sensor: Handle) -> Packets:
        """Measure now; gives what readVisionSensor gives."""
        return 0, _statistics(measure_camera(self._simulation, self._resolve(sensor)))

    def checkVisionSensor(self, sensor: Handle, entity: Handle) -> Packets:
        """1 when a picture of now shows any part of an object, or anything at all for sim.handle_all, else 0."""
        image = measure_camera(self._simulation, self._resolve(sensor))
        if entity == self.handle_all:
            seen = image.objects >= 0
        else:
            seen = np.isin(image.objects, self._with_all_below(self._resolve(entity)))
        return int(seen.any()), _statistics(image)

    def transformImage(self, image: Bytes, resolution: Integers, options: int) -> bytes:
        """An image flipped: options 2 left to right, 4 top to bottom; 1 says that it has four bytes a pixel."""
        width, height = resolution
        channels = 4 if options & _FOUR_CHANNELS else 3
        if len(image) != width * height * channels:
            raise ValueError(f"{width} x {height} pixels of {channels} bytes are not {len(image)} bytes")
        pixels = np.frombuffer(image, np.uint8).reshape(height, width, channels)
        if options & _FLIP_X:
            pixels = pixels[:, ::-1]
        if options & _FLIP_Y:
            pixels = pixels[::-1]
        return pixels.tobytes()

    def readLidar(self, sensor: Handle) -> Array:
        """Ranges in metres, rings x samples, as an array that is not copied: inf for nothing in range."""
        ranges: Array = read_lidar(self._simulation, self._resolve(sensor)).ranges
        return ranges

    def readLidarPoints(self, sensor: Handle) -> Array:
        """What the lidar met, as an array of count x 3 of float32: x, y, z in metres in the sensor's frame."""
        points: Array = read_lidar(self._simulation, self._resolve(sensor)).points
        return points

    def _optics(self, sensor: int) -> tuple[int, int, float]:
        """Width and height in pixels, and the field of view across, rad; without looking through the camera."""
        optics: tuple[int, int, float] = camera_optics(self._simulation, self._resolve(sensor))
        return optics

    def _picture(self, image: Any, sensor: int) -> Array:
        if image.rgb is None:
            path = self._world.short_path(self._resolve(sensor))
            raise ValueError(f"{path} is a depth camera, which has no picture: sim.getVisionSensorDepth reads it")
        pixels: Array = image.rgb
        return pixels


def _buffer(image: Any) -> Array:
    """Depths from 0 at the near plane to 1 at the far one."""
    depth: Array = (np.clip(image.depth, image.near, image.far) - image.near) / (image.far - image.near)
    return depth


def _part(rows: Array, position: Any, size: Any) -> Array:
    """The part of some rows that starts at a column and row; a size of 0 reaches to the end."""
    height, width = rows.shape[:2]
    (x, y), (columns, lines) = position, size
    right, top = x + columns if columns else width, y + lines if lines else height
    if not (0 <= x < right <= width and 0 <= y < top <= height):
        raise ValueError(f"the part at {[x, y]} of size {[columns, lines]} is not within {width} x {height} pixels")
    return rows[y:top, x:right]


def _statistics(image: Any) -> list[float]:
    depth = _buffer(image)
    pixels = np.zeros((*depth.shape, 3)) if image.rgb is None else image.rgb / 255
    channels = np.dstack([pixels.mean(axis=2), pixels, depth]).reshape(-1, 5)
    return [float(value) for of in (np.min, np.max, np.mean) for value in of(channels, axis=0)]
