# SPDX-License-Identifier: BSD-3-Clause
"""The module `simIM` of one child script."""

from __future__ import annotations

from typing import Any

import numpy as np

from bubblesim._core import camera_optics, override_image, read_camera
from bubblesim.scripting.api.functions import script_module
from bubblesim.scripting.api.image.arithmetic import ArithmeticFunctions
from bubblesim.scripting.api.image.hls import hls_of_rgb, rgb_of_hls
from bubblesim.scripting.api.kinds import Bytes, Handle, Integers

_SELF = -4
_MOST_PIXELS = 1 << 26


@script_module("simIM")
class SimIm(ArithmeticFunctions):
    """Images by handle, with numbers from 0 to 255, or any in formats with 32 bits; x counts from the left, y from the
    top. Operations return a new image, or with ``in_place`` change their first one and return it. Images end with their
    script. Points and colours are tables, or single numbers as in older versions."""

    def create(self, width: int, height: int, image_format: int = 3601, value: int = 0) -> int:
        """Create an image and return its handle; ``image_format``: simIM.fmt_8UC3 for example."""
        kind, channels = self._format(image_format)
        self._check_size(width, height)
        return self._keep(np.full((height, width, channels), value, kind))

    def createFromData(self, width: int, height: int, data: Bytes, image_format: int = 3601) -> int:
        """Create an image from its bytes and return its handle."""
        kind, channels = self._format(image_format)
        self._check_size(width, height)
        pixels = np.frombuffer(data, kind)
        if pixels.size != width * height * channels:
            raise ValueError(f"{width} x {height} pixels have {width * height * channels} numbers, found {pixels.size}")
        return self._keep(pixels.reshape(height, width, channels).copy())

    def destroy(self, image: int) -> None:
        """Forget an image."""
        self._at(image)
        del self._images[image]

    def numActiveHandles(self) -> int:
        """Return the number of images."""
        return len(self._images)

    def readFromVisionSensor(self, sensor: Handle) -> int:
        """Return a new image with what a camera has measured last."""
        picture = read_camera(self._simulation, self._sensor(sensor))
        if picture.rgb is None:
            raise ValueError("a depth camera has no colour image")
        return self._keep(np.array(picture.rgb, np.uint8))

    def writeToVisionSensor(self, image: int, sensor: Handle) -> None:
        """Give an image to a camera, whose image it is until the next measurement is processed."""
        camera = self._sensor(sensor)
        columns, rows, _ = camera_optics(self._simulation, camera)
        pixels = self._at(image)
        if pixels.shape[:2] != (rows, columns):
            raise ValueError(f"the image has {pixels.shape[1]} x {pixels.shape[0]} pixels, not {columns} x {rows}")
        shown = np.repeat(pixels, 3, axis=2) if pixels.shape[2] == 1 else pixels[:, :, :3]
        override_image(
            self._simulation, camera, np.ascontiguousarray(np.clip(shown, 0, 255).astype(np.uint8)).tobytes()
        )

    def writeToTexture(self, image: int, texture: int) -> None:
        """Accept an image for a texture: textures are those of the file."""
        self._at(image)

    def size(self, image: int) -> list[int]:
        """Return [width, height]."""
        rows, columns = self._at(image).shape[:2]
        return [columns, rows]

    def data(self, image: int) -> bytes:
        """Return the numbers as bytes, rows from top to bottom."""
        return self._at(image).tobytes()

    def get(self, image: int, x: Any, y: Any = None) -> list[float]:
        """Return the numbers of a pixel."""
        column, row = self._pixel(image, x, y)
        return [float(number) for number in self._at(image)[row, column]]

    def set(self, image: int, x: Any, y: Any, value: Any = None) -> None:
        """Set the numbers of a pixel."""
        column, row = self._pixel(image, x, None if isinstance(x, list | tuple) else y)
        self._at(image)[row, column] = y if isinstance(x, list | tuple) else value

    def copy(self, image: int, *arguments: Any) -> None:
        """Copy a part of an image, from a point, to another one, to a point, of a size."""
        flat: list[int] = []
        for each in arguments:
            flat += [int(number) for number in each] if isinstance(each, list | tuple) else [int(each)]
        if len(flat) != 7:
            raise TypeError("simIM.copy: a point, another image, a point and a size are needed")
        x, y, other, to_x, to_y, width, height = flat
        part, target = self._at(image)[y : y + height, x : x + width], self._at(other)
        if min(x, y, to_x, to_y) < 0 or target[to_y : to_y + height, to_x : to_x + width].shape != part.shape:
            raise ValueError("simIM.copy: the part is not within both images, or they have other channels")
        target[to_y : to_y + height, to_x : to_x + width] = part

    def resize(self, image: int, width: int, height: int, method: int = 1201, in_place: bool = False) -> int:
        """Resize an image; ``method`` simIM.interp_nearest, or linear for the others."""
        self._check_size(width, height)
        pixels = self._at(image)
        rows, columns = pixels.shape[:2]
        y = (np.arange(height) + 0.5) * rows / height - 0.5
        x = (np.arange(width) + 0.5) * columns / width - 0.5
        if method == self.interp_nearest:
            row = np.clip(np.floor(y + 0.5), 0, rows - 1).astype(int)
            column = np.clip(np.floor(x + 0.5), 0, columns - 1).astype(int)
            return self._result(image, pixels[row[:, None], column], in_place)
        y, x = np.clip(y, 0, rows - 1), np.clip(x, 0, columns - 1)
        low, left = np.floor(y).astype(int), np.floor(x).astype(int)
        high, right = np.minimum(low + 1, rows - 1), np.minimum(left + 1, columns - 1)
        down, across = (y - low)[:, None, None], (x - left)[None, :, None]
        top = pixels[low[:, None], left] * (1 - across) + pixels[low[:, None], right] * across
        bottom = pixels[high[:, None], left] * (1 - across) + pixels[high[:, None], right] * across
        return self._result(image, self._as(pixels, top * (1 - down) + bottom * down), in_place)

    def convert(self, image: int, image_format: int, scale: float = 1.0, in_place: bool = False) -> int:
        """Convert an image to another format, its numbers times a ``scale``."""
        kind, channels = self._format(image_format)
        pixels = self._at(image)
        if pixels.shape[2] != channels:
            raise ValueError(f"the image has {pixels.shape[2]} channels, not {channels}: use rgb2gray or gray2rgb")
        return self._result(image, self._as(np.zeros(1, kind), pixels * scale), in_place)

    def rgb2gray(self, image: int, in_place: bool = False) -> int:
        """Convert colours to grey: 0.299 red + 0.587 green + 0.114 blue."""
        pixels = self._at(image)
        grey = pixels[:, :, :3] @ np.array([0.299, 0.587, 0.114])
        return self._result(image, self._as(pixels, grey[:, :, None]), in_place)

    def gray2rgb(self, image: int, in_place: bool = False) -> int:
        """Convert grey to three equal channels."""
        return self._result(image, np.repeat(self._at(image)[:, :, :1], 3, axis=2), in_place)

    def rgb2hsv(self, image: int, in_place: bool = False) -> int:
        """Convert colours to hue (0 to 180, two degrees each), saturation and value (0 to 255)."""
        return self._result(image, self._in_mode(image, "RGB", "HSV", 180 / 255), in_place)

    def hsv2rgb(self, image: int, in_place: bool = False) -> int:
        """Convert hue, saturation and value to colours."""
        return self._result(image, self._in_mode(image, "HSV", "RGB", 255 / 180), in_place)

    def rgb2hls(self, image: int, in_place: bool = False) -> int:
        """Convert colours to hue (0 to 180, two degrees each), lightness and saturation (0 to 255)."""
        return self._result(image, hls_of_rgb(self._at(image)), in_place)

    def hls2rgb(self, image: int, in_place: bool = False) -> int:
        """Convert hue, lightness and saturation to colours."""
        return self._result(image, rgb_of_hls(self._at(image)), in_place)

    def flip(self, image: int, code: int, in_place: bool = False) -> int:
        """Mirror an image: top and bottom for 0, left and right above, both below 0."""
        pixels = self._at(image)
        pixels = pixels[::-1] if code <= 0 else pixels
        return self._result(image, (pixels[:, ::-1] if code else pixels).copy(), in_place)

    def repeat(self, image: int, rows: int, columns: int) -> int:
        """Return an image that is several times below and beside itself."""
        pixels = self._at(image)
        self._check_size(pixels.shape[1] * columns, pixels.shape[0] * rows)
        return self._keep(np.tile(pixels, (rows, columns, 1)))

    def split(self, image: int) -> list[int]:
        """Return an image of each channel."""
        pixels = self._at(image)
        return [self._keep(pixels[:, :, [channel]].copy()) for channel in range(pixels.shape[2])]

    def merge(self, images: Integers) -> int:
        """Return an image with the channels of several ones."""
        parts = [self._at(image) for image in images]
        if len({part.shape[:2] for part in parts}) != 1:
            raise ValueError("simIM.merge: the images have different sizes")
        return self._keep(np.concatenate(parts, axis=2))

    def read(self, file: str) -> int:
        """Return a new image from a file. For scripts that may use files: those in Python."""
        from PIL import Image

        if not self._caller.may_use_files:
            raise PermissionError("simIM.read reads files: a Python script may")
        with Image.open(file) as picture:
            self._check_size(picture.width, picture.height)
            return self._keep(np.array(picture.convert("RGB"), np.uint8))

    def write(self, image: int, file: str) -> None:
        """Write an image to a file. For scripts that may use files: those in Python."""
        if not self._caller.may_use_files:
            raise PermissionError("simIM.write writes files: a Python script may")
        self._picture(image).save(file)

    def _in_mode(self, image: int, begin: str, end: str, hues: float) -> Any:
        from PIL import Image

        pixels = np.clip(self._at(image)[:, :, :3], 0, 255).astype(np.float64)
        if begin == "HSV":
            pixels[:, :, 0] *= hues
        picture = Image.fromarray(np.clip(np.rint(pixels), 0, 255).astype(np.uint8), begin).convert(end)
        converted = np.array(picture, np.float64)
        if end == "HSV":
            converted[:, :, 0] *= hues
        return np.rint(converted).astype(np.uint8)

    def _sensor(self, sensor: int) -> int:
        return self._caller.object_handle if sensor == _SELF else sensor

    def _check_size(self, width: int, height: int) -> None:
        if width < 1 or height < 1 or width * height > _MOST_PIXELS:
            raise ValueError(f"an image has 1 to {_MOST_PIXELS} pixels, found {width} x {height}")
