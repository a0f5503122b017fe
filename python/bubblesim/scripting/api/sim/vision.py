# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for cameras and lidars."""

from __future__ import annotations

from typing import Any

import numpy as np

from bubblesim._core import camera_optics, measure_camera, override_image, read_camera, read_lidar
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Bytes, Handle, Integers
from bubblesim.scripting.api.sim.object_collections import CollectionFunctions

Array = np.ndarray[Any, Any]
Packets = tuple[int, list[float]]

_WHOLE: list[int] = [0, 0]
_GREY = 1
_METRES = 1
_FOUR_CHANNELS, _FLIP_X, _FLIP_Y = 1, 2, 4


class VisionFunctions(CollectionFunctions):
    """Images as bytes have rows from bottom to top; numpy arrays have rows from top to bottom."""

    def getVisionSensorImg(
        self,
        sensor: Handle,
        options: int = 0,
        rgba_cut_off: float = 0.0,
        position: Integers = _WHOLE,
        size: Integers = _WHOLE,
    ) -> tuple[bytes, list[int]]:
        """Return the image as bytes and its [width, height].

        Three bytes per pixel, red first; one with options 1 (grey). A cut-off above 0 adds one byte: 255 where the
        depth, 0 to 1, is below it. ``position`` and ``size`` select a part, from the lower left corner, in pixels.
        """
        image = read_camera(self._simulation, self._sensor(sensor))
        pixels = self._picture(image, sensor)
        if options & _GREY:
            pixels = pixels.mean(axis=2).round().astype(np.uint8)[:, :, None]
        if rgba_cut_off > 0:
            below = np.where(_buffer(image) < rgba_cut_off, np.uint8(255), np.uint8(0))
            pixels = np.dstack([pixels, below])
        part = _part(pixels[::-1], position, size)
        return part.tobytes(), [part.shape[1], part.shape[0]]

    def setVisionSensorImg(self, sensor: Handle, image: Bytes) -> None:
        """Replace the image of a camera: three bytes per pixel, rows from bottom to top.

        The image functions return it until the simulation restarts.
        """
        columns, rows = self.getVisionSensorRes(sensor)
        if len(image) != columns * rows * 3:
            raise ValueError(f"{columns} x {rows} pixels need {columns * rows * 3} bytes, found {len(image)}")
        top_down = np.frombuffer(image, np.uint8).reshape(rows, columns, 3)[::-1]
        override_image(self._simulation, self._sensor(sensor), top_down.tobytes())

    def setVisionSensorCharImage(self, sensor: Handle, image: Bytes) -> None:
        """Replace the image of a camera (old style)."""
        self.setVisionSensorImg(sensor, image)

    def getVisionSensorCharImage(
        self, sensor: Handle, x: int = 0, y: int = 0, width: int = 0, height: int = 0
    ) -> tuple[bytes, int, int]:
        """Return the image as bytes, its width and its height (old style); with sim.handleflag_greyscale, added to the
        handle, one byte a pixel."""
        grey = bool(sensor > 0 and sensor & self.handleflag_greyscale)
        sensor = sensor & ~self.handleflag_greyscale if grey else sensor
        data, (columns, rows) = self.getVisionSensorImg(sensor, int(grey), 0.0, [x, y], [width, height])
        return data, columns, rows

    def getVisionSensorDepth(
        self,
        sensor: Handle,
        options: int = 0,
        position: Integers = _WHOLE,
        size: Integers = _WHOLE,
    ) -> tuple[bytes, list[int]]:
        """Return depths as packed floats, for sim.unpackFloatTable, and their [width, height].

        0 at the near plane to 1 at the far plane; with options 1 in metres along the optical axis.
        """
        image = read_camera(self._simulation, self._sensor(sensor))
        depth = np.clip(image.depth, image.near, image.far) if options & _METRES else _buffer(image)
        part = _part(depth[::-1], position, size)
        return part.astype(np.float32).tobytes(), [part.shape[1], part.shape[0]]

    def getVisionSensorRes(self, sensor: Handle) -> list[int]:
        """Return [width, height] in pixels."""
        columns, rows, _ = self._optics(sensor)
        return [columns, rows]

    def getVisionSensorFieldOfView(self, sensor: Handle) -> float:
        """Return the horizontal field of view in radians."""
        return self._optics(sensor)[2]

    def getVisionSensorArray(self, sensor: Handle) -> Array:
        """Return the image as an array of height x width x 3 without a copy, rows from top to bottom."""
        return self._picture(read_camera(self._simulation, self._sensor(sensor)), sensor)

    def readVisionSensor(self, sensor: Handle) -> tuple[Any, ...]:
        """Return 0, and minimum, maximum and mean of the last image's intensity, red, green, blue and depth.

        A sysCall_vision of the camera's script may set the result to 1, and add lists of numbers.
        """
        handle = self._sensor(sensor)
        triggered, packets = self._caller.shared.vision_results.get(handle, (False, []))
        more = [np.frombuffer(_raw(packet), np.float32).tolist() for packet in packets]
        return (int(triggered), _statistics(read_camera(self._simulation, handle)), *more)

    @differs("with sim.handle_all, all cameras measure; here they do when they are due")
    def handleVisionSensor(self, sensor: Handle) -> Packets:
        """Measure now; return the same as readVisionSensor; for sim.handle_all, and handle_all_except_explicit,
        nothing: cameras measure when they are due."""
        if sensor in (self.handle_all, self.handle_all_except_explicit):
            return 0, []
        return 0, _statistics(measure_camera(self._simulation, self._sensor(sensor)))

    def checkVisionSensor(self, sensor: Handle, entity: Handle) -> Packets:
        """Measure now; return 1 if any part of an object or collection is visible, else 0.

        sim.handle_all stands for any object.
        """
        image = measure_camera(self._simulation, self._sensor(sensor))
        entity = entity if entity == self.handle_all else self._resolve(entity)
        seen = any(self._belongs(int(link), entity) for link in np.unique(image.objects) if link >= 0)
        return int(seen), _statistics(image)

    def getVisionSensorImage(
        self, sensor: Handle, x: int = 0, y: int = 0, width: int = 0, height: int = 0, returns: int = 0
    ) -> Any:
        """Return the image as numbers from 0 to 1, red, green and blue of each pixel, rows from bottom to top (old
        style). ``returns`` 1: as bytes. sim.handleflag_greyscale, added to the handle: one number a pixel."""
        grey = bool(sensor > 0 and sensor & self.handleflag_greyscale)
        sensor = sensor & ~self.handleflag_greyscale if grey else sensor
        data, _ = self.getVisionSensorImg(sensor, int(grey), 0.0, [x, y], [width, height])
        return data if returns else (np.frombuffer(data, np.uint8) / 255.0).tolist()

    def setVisionSensorImage(self, sensor: Handle, image: Any) -> None:
        """Replace the image of a camera, by numbers from 0 to 1 or by bytes (old style)."""
        if not isinstance(image, bytes | bytearray | memoryview | str):
            image = np.clip(np.asarray(image, float) * 255.0 + 0.5, 0, 255).astype(np.uint8).tobytes()
        self.setVisionSensorImg(sensor, image)

    def getVisionSensorDepthBuffer(
        self, sensor: Handle, x: int = 0, y: int = 0, width: int = 0, height: int = 0
    ) -> Any:
        """Return depths, 0 at the near plane to 1 at the far plane, rows from bottom to top (old style). Added to the
        handle, sim.handleflag_depthbuffermeters gives metres, and handleflag_codedstring packed floats."""
        flags = sensor & (self.handleflag_depthbuffermeters | self.handleflag_codedstring) if sensor > 0 else 0
        metres = int(bool(flags & self.handleflag_depthbuffermeters))
        data, _ = self.getVisionSensorDepth(sensor & ~flags if flags else sensor, metres, [x, y], [width, height])
        return data if flags & self.handleflag_codedstring else np.frombuffer(data, np.float32).tolist()

    def getVisionSensorResolution(self, sensor: Handle) -> list[int]:
        """Return [width, height] in pixels (old name of getVisionSensorRes)."""
        return self.getVisionSensorRes(sensor)

    def transformImage(self, image: Bytes, resolution: Integers, options: int) -> bytes:
        """Flip an image: options 2 left to right, 4 top to bottom; 1 for four bytes per pixel."""
        width, height = resolution
        channels = 4 if options & _FOUR_CHANNELS else 3
        if len(image) != width * height * channels:
            raise ValueError(f"{width} x {height} pixels need {width * height * channels} bytes, found {len(image)}")
        pixels: Array = np.frombuffer(image, np.uint8).reshape(height, width, channels)
        if options & _FLIP_X:
            pixels = pixels[:, ::-1]
        if options & _FLIP_Y:
            pixels = pixels[::-1]
        return pixels.tobytes()

    def readLidar(self, sensor: Handle) -> Array:
        """Return ranges in metres, rings x samples, as an array without a copy; inf without a return."""
        ranges: Array = read_lidar(self._simulation, self._sensor(sensor)).ranges
        return ranges

    def readLidarPoints(self, sensor: Handle) -> Array:
        """Return the last scan's points, an array of count x 3 of float32: x, y, z in metres in the sensor's frame."""
        points: Array = read_lidar(self._simulation, self._sensor(sensor)).points
        return points

    def _optics(self, sensor: int) -> tuple[int, int, float]:
        """Return width and height in pixels, and the horizontal field of view, rad, without rendering."""
        optics: tuple[int, int, float] = camera_optics(self._simulation, self._sensor(sensor))
        return optics

    def _picture(self, image: Any, sensor: int) -> Array:
        if image.rgb is None:
            path = self._world.short_path(self._sensor(sensor))
            raise ValueError(f"{path} is a depth camera without colour image: use sim.getVisionSensorDepth")
        pixels: Array = image.rgb
        return pixels


def _buffer(image: Any) -> Array:
    """Return depths from 0 at the near plane to 1 at the far plane."""
    depth: Array = (np.clip(image.depth, image.near, image.far) - image.near) / (image.far - image.near)
    return depth


def _part(rows: Array, position: Any, size: Any) -> Array:
    """Return the part of an image that starts at a column and row; a size of 0 extends to the border."""
    height, width = rows.shape[:2]
    (x, y), (columns, lines) = position, size
    right, top = x + columns if columns else width, y + lines if lines else height
    if not (0 <= x < right <= width and 0 <= y < top <= height):
        raise ValueError(f"the part at {[x, y]} of size {[columns, lines]} exceeds the {width} x {height} pixels")
    return rows[y:top, x:right]


def _statistics(image: Any) -> list[float]:
    depth = _buffer(image)
    pixels = np.zeros((*depth.shape, 3)) if image.rgb is None else image.rgb / 255
    channels = np.dstack([pixels.mean(axis=2), pixels, depth]).reshape(-1, 5)
    return [float(value) for of in (np.min, np.max, np.mean) for value in of(channels, axis=0)]


def _raw(packet: Any) -> bytes:
    data = packet.encode("latin-1") if isinstance(packet, str) else bytes(packet)
    return data[: len(data) // 4 * 4]
