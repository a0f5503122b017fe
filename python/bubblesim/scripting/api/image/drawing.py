# SPDX-License-Identifier: BSD-3-Clause
"""`simIM` functions that draw, and the images that they draw into."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from bubblesim.scripting.api.image.arguments import Rest
from bubblesim.scripting.api.kinds import Integers
from bubblesim.scripting.caller import Caller

Array = np.ndarray[Any, Any]
_MOST_IMAGES = 1000
_TEXT_HEIGHT = 11  # pixels, of a letter at a scale of 1: that of the library's font


class DrawingFunctions:
    """Lines have a ``thickness`` in pixels; a negative one fills."""

    fmt_8UC1 = 3600  # noqa: N815
    fmt_8UC3 = 3601  # noqa: N815
    fmt_8UC4 = 3602  # noqa: N815
    fmt_32FC1 = 3603  # noqa: N815
    fmt_32FC3 = 3604  # noqa: N815
    fmt_32FC4 = 3605  # noqa: N815
    interp_nearest = 1200
    interp_linear = 1201
    interp_area = 1202
    interp_cubic = 1203
    interp_lanczos4 = 1204
    fontface_simplex = 9000
    fontface_plain = 9001
    fontface_duplex = 9002
    fontface_complex = 9003
    fontface_triplex = 9004
    fontface_complex_small = 9005
    fontface_script_simplex = 9006
    fontface_script_complex = 9007

    def __init__(self, runner: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        self._caller = caller
        self._simulation = runner.simulation
        self._images: dict[int, Array] = {}
        self._made = 0

    def line(self, image: int, *arguments: Any) -> None:
        """Draw a line between two points, with a colour and a thickness."""
        rest = Rest(arguments)
        ends, colour, width = [rest.point(), rest.point()], rest.colour(), rest.number(1)
        self._lines(image, ends, colour, width)

    def rectangle(self, image: int, *arguments: Any) -> None:
        """Draw a rectangle between two corners, with a colour and a thickness."""
        rest = Rest(arguments)
        (a, b), (c, d), colour, width = rest.point(), rest.point(), rest.colour(), rest.number(1)
        box = [min(a, c), min(b, d), max(a, c), max(b, d)]
        self._draw(image, lambda pen: pen.rectangle(box, **_look(colour, width)))

    def circle(self, image: int, *arguments: Any) -> None:
        """Draw a circle about a point, with a radius, a colour and a thickness."""
        rest = Rest(arguments)
        (x, y), radius, colour, width = rest.point(), rest.number(1), rest.colour(), rest.number(1)
        box = [x - radius, y - radius, x + radius, y + radius]
        self._draw(image, lambda pen: pen.ellipse(box, **_look(colour, width)))

    def ellipse(self, image: int, *arguments: Any) -> None:
        """Draw an arc of an ellipse about a point, with two radii, a rotation (without effect), a first and a last
        angle in degrees, a colour and a thickness."""
        rest = Rest(arguments)
        (x, y), (a, b) = rest.point(), rest.point()
        _, begin, end = rest.number(0), rest.number(0), rest.number(360)
        colour, width = rest.colour(), rest.number(1)
        box = [x - a, y - b, x + a, y + b]
        if width < 0:
            self._draw(image, lambda pen: pen.pieslice(box, begin, end, fill=colour))
        else:
            self._draw(image, lambda pen: pen.arc(box, begin, end, fill=colour, width=max(1, int(width))))

    def polylines(self, image: int, points: Integers, counts: Integers, closed: bool, *arguments: Any) -> None:
        """Draw lines through points, of which ``counts`` belong to one line each, with a colour and a thickness."""
        rest = Rest(arguments)
        colour, width = rest.colour(), rest.number(1)
        for part in _parts(points, counts):
            self._lines(image, [*part, part[0]] if closed else part, colour, width)

    def fillPoly(self, image: int, points: Integers, counts: Integers, *arguments: Any) -> None:
        """Fill areas, of which ``counts`` points belong to one each, with an offset (a table) and a colour."""
        is_new = len(arguments) > 1 and isinstance(arguments[0], list | tuple) and len(arguments[0]) == 2
        rest = Rest(arguments)
        x, y = rest.point() if is_new else (0, 0)
        colour = rest.colour()
        for part in _parts(points, counts):
            self._area(image, [(a + x, b + y) for a, b in part], colour)

    def fillConvexPoly(self, image: int, points: Integers, *arguments: Any) -> None:
        """Fill an area between points with a colour."""
        self.fillPoly(image, points, [len(points) // 2], *arguments)

    def text(self, image: int, words: str, *arguments: Any) -> None:
        """Write words with their lower left corner at a point; then a font and italics (without effect), a scale, and a
        colour."""
        from PIL import Image, ImageDraw, ImageFont

        rest = Rest(arguments)
        (x, y), _, _ = rest.point(), rest.number(0), rest.number(0)
        scale, colour = rest.number(1), rest.colour()
        width, height, _ = self.textSize(words)
        mask = Image.new("L", (max(1, width), max(1, height)))
        ImageDraw.Draw(mask).text((0, 0), words, fill=255, font=ImageFont.load_default())
        size = max(1, round(width * scale)), max(1, round(height * scale))
        stamp = mask.resize(size)
        self._draw(image, lambda pen: pen.bitmap((x, y - size[1]), stamp, fill=colour))

    def textSize(
        self, words: str, font: int = 9000, italic: bool = False, scale: float = 1.0, thickness: int = 1
    ) -> tuple[int, int, int]:
        """Return width and height of words, and how far they reach below their line, in pixels."""
        from PIL import ImageFont

        _, _, right, bottom = ImageFont.load_default().getbbox(words or " ")
        return round(float(right) * scale), round(float(bottom) * scale), max(0, round(bottom - _TEXT_HEIGHT))

    def _lines(self, image: int, ends: list[tuple[int, int]], colour: tuple[int, int, int], width: float) -> None:
        self._draw(image, lambda pen: pen.line(ends, fill=colour, width=max(1, int(width))))

    def _area(self, image: int, corners: list[tuple[int, int]], colour: tuple[int, int, int]) -> None:
        self._draw(image, lambda pen: pen.polygon(corners, fill=colour))

    def _draw(self, image: int, action: Callable[[Any], None]) -> None:
        from PIL import ImageDraw

        picture = self._picture(image)
        action(ImageDraw.Draw(picture))
        pixels, drawn = self._at(image), np.array(picture)
        pixels[...] = drawn[:, :, : pixels.shape[2]] if pixels.shape[2] > 1 else drawn[:, :, :1]

    def _picture(self, image: int) -> Any:
        from PIL import Image

        pixels = np.clip(self._at(image), 0, 255).astype(np.uint8)
        if pixels.shape[2] == 1:
            pixels = np.repeat(pixels, 3, axis=2)
        return Image.fromarray(np.ascontiguousarray(pixels), "RGBA" if pixels.shape[2] == 4 else "RGB")

    def _format(self, number: int) -> tuple[Any, int]:
        """Return type and channels of a format."""
        if not self.fmt_8UC1 <= number <= self.fmt_32FC4:
            raise ValueError(f"{number} is not a format of images: use simIM.fmt_8UC3 for example")
        return (np.uint8 if number < self.fmt_32FC1 else np.float32), (1, 3, 4)[(number - self.fmt_8UC1) % 3]

    def _at(self, image: int) -> Array:
        if image not in self._images:
            raise LookupError(f"no image of simIM has the handle {image}")
        return self._images[image]

    def _keep(self, pixels: Array) -> int:
        if len(self._images) >= _MOST_IMAGES:
            raise ValueError(f"a script has at most {_MOST_IMAGES} images: destroy some")
        self._made += 1
        self._images[self._made] = pixels
        return self._made

    def _result(self, image: int, pixels: Array, in_place: bool) -> int:
        if not in_place:
            return self._keep(pixels)
        self._images[image] = pixels
        return image

    def _as(self, like: Array, numbers: Array) -> Array:
        """Return numbers in the type of an array, rounded and limited."""
        if like.dtype != np.uint8:
            return numbers.astype(like.dtype)
        return np.clip(np.rint(numbers), 0, 255).astype(np.uint8)

    def _combined(self, image: int, other: Array, action: Callable[[Array, Array], Array], in_place: bool) -> int:
        pixels = self._at(image)
        if other.ndim == 3 and other.shape != pixels.shape:
            raise ValueError(f"the images have different sizes: {pixels.shape} and {other.shape}")
        return self._result(image, self._as(pixels, action(pixels.astype(float), other.astype(float))), in_place)

    def _constant(self, image: int, numbers: list[float]) -> Array:
        channels = self._at(image).shape[2]
        if len(numbers) not in (1, channels):
            raise ValueError(f"an image of {channels} channels takes as many numbers, found {len(numbers)}")
        return np.array(numbers)

    def _pixel(self, image: int, x: Any, y: Any) -> tuple[int, int]:
        column, row = Rest([x] if isinstance(x, list | tuple) else [x, y]).point()
        rows, columns = self._at(image).shape[:2]
        if not (0 <= column < columns and 0 <= row < rows):
            raise ValueError(f"({column}, {row}) is not a pixel of an image of {columns} x {rows}")
        return column, row


def _look(colour: tuple[int, int, int], width: float) -> dict[str, Any]:
    return {"fill": colour} if width < 0 else {"outline": colour, "width": max(1, int(width))}


def _parts(points: list[int], counts: list[int]) -> list[list[tuple[int, int]]]:
    pairs = list(zip(points[::2], points[1::2], strict=False))
    if sum(counts) != len(pairs) or min(counts, default=0) < 1:
        raise ValueError(f"{len(pairs)} points do not make parts of {counts}")
    found, begin = [], 0
    for count in counts:
        found.append(pairs[begin : begin + count])
        begin += count
    return found
