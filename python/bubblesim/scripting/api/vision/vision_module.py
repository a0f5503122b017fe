# SPDX-License-Identifier: BSD-3-Clause
"""The module `simVision` of one child script."""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass
from typing import Any

import numpy as np

from bubblesim._core import camera_optics, override_image, read_camera
from bubblesim.scene_state.handle_error import MAX_HANDLE, HandleError
from bubblesim.scene_state.object_tree import acting_object
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.functions import script_module
from bubblesim.scripting.api.kinds import Handle, Integers, Numbers, Vector3
from bubblesim.scripting.api.vision import work_images
from bubblesim.scripting.api.vision.work_images import Array
from bubblesim.scripting.caller import Caller

_SELF = -4
_MOST_POINTS = 100_000


@dataclass
class _Work:
    """The images of a camera: rows from bottom to top, numbers from 0 to 1."""

    image: Array
    depth: Array
    near: float
    far: float
    buffers: list[Array]


@script_module("simVision")
class SimVision:
    """Each camera has a work image and two buffers, for sysCall_vision and other callbacks. Colours have red, green and
    blue from 0 to 1; rows count from the bottom."""

    def __init__(self, runner: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        self._caller = caller
        self._simulation = runner.simulation
        self._kept: dict[int, _Work] = {}

    def sensorImgToWorkImg(self, sensor: Handle) -> None:
        """Take the image of a camera as its work image."""
        work = self._work(sensor)
        picture = read_camera(self._simulation, self._resolve(sensor))
        if picture.rgb is None:
            raise ValueError("a depth camera has no colour image: use simVision.sensorDepthMapToWorkImg")
        work.image = picture.rgb[::-1].astype(float) / 255
        work.depth = picture.depth[::-1].astype(float)

    def sensorDepthMapToWorkImg(self, sensor: Handle) -> None:
        """Take the depths of a camera, 0 at the near plane to 1 at the far plane, as its work image."""
        work = self._work(sensor)
        picture = read_camera(self._simulation, self._resolve(sensor))
        work.depth = picture.depth[::-1].astype(float)
        share = (np.clip(work.depth, work.near, work.far) - work.near) / (work.far - work.near)
        work.image = np.repeat(share[:, :, None], 3, axis=2)

    def workImgToSensorImg(self, sensor: Handle, remove_buffer: bool = True) -> None:
        """Give the work image to a camera, whose image it is until the next measurement is processed."""
        image = np.clip(self._work(sensor).image, 0, 1)
        columns, rows, _ = camera_optics(self._simulation, self._resolve(sensor))
        if image.shape[:2] != (rows, columns):
            raise ValueError(f"the work image has {image.shape[1]} x {image.shape[0]} pixels, not {columns} x {rows}")
        pixels = np.ascontiguousarray((image[::-1] * 255 + 0.5).astype(np.uint8))
        override_image(self._simulation, self._resolve(sensor), pixels.tobytes())

    @differs("it replaces the depths of a camera; here the camera keeps its own")
    def workImgToSensorDepthMap(self, sensor: Handle, remove_buffer: bool = True) -> None:
        """Accept depths for a camera, which keeps its own."""
        self._work(sensor)

    def workImgToBuffer1(self, sensor: Handle) -> None:
        """Copy the work image to the first buffer."""
        self._work(sensor).buffers[0] = self._work(sensor).image.copy()

    def workImgToBuffer2(self, sensor: Handle) -> None:
        """Copy the work image to the second buffer."""
        self._work(sensor).buffers[1] = self._work(sensor).image.copy()

    def buffer1ToWorkImg(self, sensor: Handle) -> None:
        """Copy the first buffer to the work image."""
        self._work(sensor).image = self._work(sensor).buffers[0].copy()

    def buffer2ToWorkImg(self, sensor: Handle) -> None:
        """Copy the second buffer to the work image."""
        self._work(sensor).image = self._work(sensor).buffers[1].copy()

    def swapBuffers(self, sensor: Handle) -> None:
        """Exchange both buffers."""
        self._work(sensor).buffers.reverse()

    def swapWorkImgWithBuffer1(self, sensor: Handle) -> None:
        """Exchange the work image and the first buffer."""
        work = self._work(sensor)
        work.image, work.buffers[0] = work.buffers[0], work.image

    def addBuffer1ToWorkImg(self, sensor: Handle) -> None:
        """Add the first buffer to the work image."""
        work = self._work(sensor)
        work.image = np.clip(work.image + work.buffers[0], 0, 1)

    def subtractBuffer1FromWorkImg(self, sensor: Handle) -> None:
        """Subtract the first buffer from the work image."""
        work = self._work(sensor)
        work.image = np.clip(work.image - work.buffers[0], 0, 1)

    def multiplyWorkImgWithBuffer1(self, sensor: Handle) -> None:
        """Multiply the work image by the first buffer."""
        work = self._work(sensor)
        work.image = work.image * work.buffers[0]

    def uniformImgToWorkImg(self, sensor: Handle, colour: Vector3) -> None:
        """Fill the work image with a colour."""
        self._work(sensor).image[:] = colour

    def horizontalFlipWorkImg(self, sensor: Handle) -> None:
        """Flip the work image left to right."""
        self._work(sensor).image = self._work(sensor).image[:, ::-1].copy()

    def verticalFlipWorkImg(self, sensor: Handle) -> None:
        """Flip the work image top to bottom."""
        self._work(sensor).image = self._work(sensor).image[::-1].copy()

    def rotateWorkImg(self, sensor: Handle, angle: float) -> None:
        """Rotate the work image by an angle in rad."""
        self._work(sensor).image = work_images.rotated(self._work(sensor).image, angle)

    def shiftWorkImg(self, sensor: Handle, shift: Numbers, wrap: bool = False) -> None:
        """Shift the work image by shares of its width and height."""
        work = self._work(sensor)
        rows, columns = work.image.shape[:2]
        across, up = round(shift[0] * columns), round(shift[1] * rows)
        moved = np.roll(work.image, (up, across), axis=(0, 1))
        if not wrap:
            y, x = np.mgrid[:rows, :columns]
            inside = (x - across >= 0) & (x - across < columns) & (y - up >= 0) & (y - up < rows)
            moved[~inside] = 0
        work.image = moved

    def edgeDetectionOnWorkImg(self, sensor: Handle, threshold: float) -> None:
        """Make the work image white where the intensity changes by more than a threshold, else black."""
        self._work(sensor).image = work_images.edges(self._work(sensor).image, threshold)

    def sharpenWorkImg(self, sensor: Handle) -> None:
        """Sharpen the work image."""
        kernel = np.array([[-1, -1, -1], [-1, 12, -1], [-1, -1, -1]]) / 4
        self._work(sensor).image = np.clip(work_images.blurred_by(self._work(sensor).image, kernel), 0, 1)

    def matrix3x3OnWorkImg(self, sensor: Handle, passes: int, factor: float, matrix: Any = None) -> None:
        """Filter the work image with a 3 x 3 matrix, times a factor, several times."""
        self._filter(sensor, passes, factor, matrix, 3)

    def matrix5x5OnWorkImg(self, sensor: Handle, passes: int, factor: float, matrix: Any = None) -> None:
        """Filter the work image with a 5 x 5 matrix, times a factor, several times."""
        self._filter(sensor, passes, factor, matrix, 5)

    def rectangularCutWorkImg(self, sensor: Handle, size: Numbers, to_buffer: bool = False) -> None:
        """Keep a rectangle in the centre: shares of width and height. ``to_buffer``: the first buffer gets the rest."""
        work = self._work(sensor)
        rows, columns = work.image.shape[:2]
        y, x = np.mgrid[:rows, :columns]
        inside = (np.abs((x + 0.5) / columns - 0.5) <= size[0] / 2) & (np.abs((y + 0.5) / rows - 0.5) <= size[1] / 2)
        self._cut(work, inside, to_buffer)

    def circularCutWorkImg(self, sensor: Handle, radius: float, to_buffer: bool = False) -> None:
        """Keep a circle in the centre: a share of half the smaller side. ``to_buffer``: the first buffer gets the
        rest."""
        work = self._work(sensor)
        rows, columns = work.image.shape[:2]
        y, x = np.mgrid[:rows, :columns]
        limit = radius * min(rows, columns) / 2
        self._cut(work, np.hypot(x + 0.5 - columns / 2, y + 0.5 - rows / 2) <= limit, to_buffer)

    def normalizeWorkImg(self, sensor: Handle) -> None:
        """Scale the work image so that its numbers go from 0 to 1."""
        work = self._work(sensor)
        low, high = float(work.image.min()), float(work.image.max())
        work.image = (work.image - low) / (high - low) if high > low else np.zeros_like(work.image)

    def scaleAndOffsetWorkImg(
        self, sensor: Handle, before: Vector3, scaling: Vector3, after: Vector3, rgb: bool = True
    ) -> None:
        """Add to the colours of the work image, multiply them, and add again."""
        work = self._work(sensor)
        work.image = np.clip((work.image + before) * scaling + after, 0, 1)

    def intensityScaleOnWorkImg(self, sensor: Handle, start: Vector3, end: Vector3, grey: bool = True) -> None:
        """Colour the work image by its intensity, from one colour to another one."""
        work = self._work(sensor)
        intensity = work.image.mean(axis=2)[:, :, None]
        work.image = np.asarray(start) * (1 - intensity) + np.asarray(end) * intensity

    def selectiveColorOnWorkImg(
        self,
        sensor: Handle,
        colour: Vector3,
        tolerance: Vector3,
        rgb: bool = True,
        keep: bool = True,
        to_buffer: bool = False,
    ) -> None:
        """Keep the pixels with a colour within a tolerance: red, green, blue, or hue, saturation, lightness if ``rgb``
        is false; ``keep`` false: the others. ``to_buffer``: the first buffer gets the rest."""
        work = self._work(sensor)
        values = work.image if rgb else work_images.hsl(work.image)
        difference = np.abs(values - np.asarray(colour))
        if not rgb:
            difference[:, :, 0] = np.minimum(difference[:, :, 0], 1 - difference[:, :, 0])
        inside = (difference <= np.asarray(tolerance) + 1e-9).all(axis=2)
        self._cut(work, inside if keep else ~inside, to_buffer)

    def binaryWorkImg(self, sensor: Handle, threshold: float, *more: Any) -> tuple[bool, bytes]:
        """Make the work image white where the intensity is above a threshold, else black; return whether any is, and
        packed floats: the share of white, and x and y of its centre."""
        work = self._work(sensor)
        mask = work.image.mean(axis=2) > threshold
        work.image = np.repeat(mask.astype(float)[:, :, None], 3, axis=2)
        rows, columns = mask.shape
        found = np.argwhere(mask)
        centre = [(found[:, 1].mean() + 0.5) / columns, (found[:, 0].mean() + 0.5) / rows] if len(found) else [0.0, 0.0]
        return bool(len(found)), _packed([float(mask.mean()), *map(float, centre)])

    def blobDetectionOnWorkImg(
        self, sensor: Handle, threshold: float, smallest: float, modify: bool = False, *more: Any
    ) -> tuple[bool, bytes]:
        """Find the connected areas that are brighter than a threshold and larger than a share of the image; return
        whether there are any, and packed floats: their number, 6, and of each size, orientation (rad), x and y of the
        centre, width and height of its box, as shares of the image. ``modify``: the work image shows them alone."""
        work = self._work(sensor)
        rows, columns = work.image.shape[:2]
        labels, count = work_images.labelled(work.image.mean(axis=2) > threshold)
        blobs: list[list[float]] = []
        kept = np.zeros(labels.shape, bool)
        for number in range(1, count + 1):
            places = np.argwhere(labels == number)
            if len(places) >= smallest * rows * columns:
                blobs.append(work_images.blob(places, columns, rows))
                kept |= labels == number
        if modify:
            self._cut(work, kept, False)
        return bool(blobs), _packed([float(len(blobs)), 6.0, *(number for each in blobs for number in each)])

    def coordinatesFromWorkImg(
        self, sensor: Handle, counts: Integers, evenly: bool = False, colours: bool = False
    ) -> tuple[bool, bytes, bytes]:
        """Return false, and packed floats: the numbers of columns and rows, and of each point x, y, z in the camera's
        frame and its distance, m; and with ``colours`` the bytes of their colours."""
        work = self._work(sensor)
        points = self._points(sensor, work, counts[0], counts[1])
        flat = [float(counts[0]), float(counts[1])]
        flat += map(float, points.ravel())
        picked = b""
        if colours:
            y, x = self._places(work, counts[0], counts[1])
            picked = (np.clip(work.image[y, x], 0, 1) * 255 + 0.5).astype(np.uint8).tobytes()
        return False, _packed(flat), picked

    def velodyneDataFromWorkImg(self, sensor: Handle, counts: Integers, angle: float = 0.0) -> tuple[bool, bytes]:
        """Return the same as coordinatesFromWorkImg, for cameras of a lidar."""
        _, data, _ = self.coordinatesFromWorkImg(sensor, counts)
        return False, data

    def changedPixelsOnWorkImg(self, sensor: Handle, threshold: float) -> tuple[bool, bytes]:
        """Compare the intensity of the work image with that of the first buffer, which then is the work image; return
        whether pixels differ by more than a threshold, and packed floats: x, y and the sign of each, up to 1000."""
        work = self._work(sensor)
        difference = work.image.mean(axis=2) - work.buffers[0].mean(axis=2)
        work.buffers[0] = work.image.copy()
        found = np.argwhere(np.abs(difference) > threshold)[:1000]
        numbers = [float(n) for y, x in found for n in (x, y, math.copysign(1, difference[y, x]))]
        return bool(len(found)), _packed(numbers)

    def handleSpherical(self, *arguments: Any) -> int:
        """Raise RuntimeError: spherical cameras are not supported; use a lidar or several cameras."""
        raise RuntimeError("simVision.handleSpherical is not supported: use a lidar, or several cameras")

    def _resolve(self, sensor: int) -> int:
        if sensor == _SELF:
            return acting_object(self._simulation.world, self._caller.object_handle)
        if not 0 <= sensor <= MAX_HANDLE:
            raise HandleError(sensor)
        edits = self._caller.shared.edits
        sensor = edits.replaced.get(sensor, sensor)
        return edits.sensors.get(sensor, sensor)

    def _work(self, sensor: int) -> _Work:
        handle = self._resolve(sensor)
        if handle not in self._kept:
            picture = read_camera(self._simulation, handle)
            rows, columns = picture.depth.shape
            black = np.zeros((rows, columns, 3))
            depth = picture.depth[::-1].astype(float)
            self._kept[handle] = _Work(black, depth, picture.near, picture.far, [black.copy(), black.copy()])
        return self._kept[handle]

    def _filter(self, sensor: int, passes: int, factor: float, matrix: Any, size: int) -> None:
        numbers = [float(number) for number in matrix] if matrix else [1.0 / (size * size)] * (size * size)
        if len(numbers) != size * size:
            raise ValueError(f"the matrix has {size * size} numbers, found {len(numbers)}")
        kernel = np.array(numbers).reshape(size, size) * factor
        work = self._work(sensor)
        for _ in range(min(max(0, passes), 100)):
            work.image = np.clip(work_images.blurred_by(work.image, kernel), 0, 1)

    def _cut(self, work: _Work, inside: Array, to_buffer: bool) -> None:
        if to_buffer:
            work.buffers[0] = np.where(inside[:, :, None], 0.0, work.image)
        work.image = np.where(inside[:, :, None], work.image, 0.0)

    def _places(self, work: _Work, columns: int, rows: int) -> tuple[Array, Array]:
        if not 0 < columns * rows <= _MOST_POINTS:
            raise ValueError(f"from 1 to {_MOST_POINTS} points can be taken, found {columns} x {rows}")
        height, width = work.depth.shape
        y = np.linspace(0, height - 1, rows).round().astype(int)
        x = np.linspace(0, width - 1, columns).round().astype(int)
        found = np.meshgrid(y, x, indexing="ij")
        return found[0], found[1]

    def _points(self, sensor: int, work: _Work, columns: int, rows: int) -> Array:
        """Return x, y, z (along the optical axis) and the distance of points; x to the left, y up."""
        y, x = self._places(work, columns, rows)
        height, width = work.depth.shape
        _, _, field = camera_optics(self._simulation, self._resolve(sensor))
        focal = width / 2 / math.tan(field / 2)
        z = np.clip(work.depth[y, x], work.near, work.far)
        left, up = (width / 2 - x - 0.5) / focal * z, (y + 0.5 - height / 2) / focal * z
        return np.stack([left, up, z, np.sqrt(left**2 + up**2 + z**2)], axis=-1)


def _packed(numbers: list[float]) -> bytes:
    return struct.pack(f"<{len(numbers)}f", *numbers)
