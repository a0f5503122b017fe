# SPDX-License-Identifier: BSD-3-Clause
"""Conversion between sensor_msgs images, as dicts, and arrays of height x width x 3 (rgb8, top row first)."""

from __future__ import annotations

from typing import Any

import numpy as np

Image = np.ndarray[Any, Any]

# By format: the parameter of its level, the range of levels and the default, as in compressed_image_transport.
COMPRESSIONS = {"jpeg": ("jpeg_quality", range(1, 101), 80), "png": ("png_level", range(1, 10), 9)}

# By encoding: bytes per pixel, and the positions of red, green and blue.
_ENCODINGS = {
    "rgb8": (3, slice(0, 3)),
    "bgr8": (3, slice(2, None, -1)),
    "rgba8": (4, slice(0, 3)),
    "bgra8": (4, slice(2, None, -1)),
    "mono8": (1, slice(0, 1)),
}


def decode(message: dict[str, Any]) -> Image:
    """Return the image of a sensor_msgs/Image. Raise a ValueError if it is invalid."""
    encoding, width, height, step = (message[name] for name in ("encoding", "width", "height", "step"))
    if encoding not in _ENCODINGS:
        raise ValueError(f"unsupported encoding {encoding!r}; supported: {', '.join(_ENCODINGS)}")
    channels, colours = _ENCODINGS[encoding]
    data = np.frombuffer(message["data"], np.uint8)
    if step < width * channels or data.size < height * step:
        raise ValueError(
            f"{width} x {height} pixels of {encoding} need a step of at least {width * channels} and height * step "
            f"bytes; found step {step} and {data.size} bytes"
        )
    rows = data[: height * step].reshape(height, step)[:, : width * channels]
    pixels = rows.reshape(height, width, channels)[:, :, colours]
    return np.broadcast_to(pixels, (height, width, 3))


def decompress(message: dict[str, Any]) -> Image:
    """Return the image of a sensor_msgs/CompressedImage. Raise a ValueError if it is invalid."""
    cv2 = opencv()
    data = np.frombuffer(message["data"], np.uint8)
    try:
        image: Image | None = cv2.imdecode(data, cv2.IMREAD_COLOR)
    except cv2.error:  # no data, or an image too large for OpenCV
        image = None
    if image is None:
        raise ValueError(f"OpenCV cannot decode {data.size} bytes of format {message['format']!r}")
    return image[:, :, ::-1]


def compress(image: Image, image_format: str, level: int) -> Image:
    """Return the image as file content in a format of COMPRESSIONS."""
    cv2 = opencv()
    flag = {"jpeg": cv2.IMWRITE_JPEG_QUALITY, "png": cv2.IMWRITE_PNG_COMPRESSION}[image_format]
    _, data = cv2.imencode(f".{image_format}", cv2.cvtColor(image, cv2.COLOR_RGB2BGR), [flag, level])
    compressed: Image = data.reshape(-1)
    return compressed


def opencv() -> Any:
    """Return the module cv2, imported on demand because it loads slowly."""
    try:
        import cv2
    except ImportError as error:
        raise ImportError(f"compressed images need OpenCV, Debian's package python3-opencv: {error}") from error
    return cv2
