# SPDX-License-Identifier: BSD-3-Clause
"""Images between the messages of sensor_msgs, as dicts, and arrays of height x width x 3 (rgb8, top row first)."""

from __future__ import annotations

from typing import Any

import numpy as np

Image = np.ndarray[Any, Any]

# By format: the name of its level among the parameters, the levels there are, and the default, all as
# compressed_image_transport has them.
COMPRESSIONS = {"jpeg": ("jpeg_quality", range(1, 101), 80), "png": ("png_level", range(1, 10), 9)}

# By encoding: bytes a pixel, and where red, green and blue are among them.
_ENCODINGS = {
    "rgb8": (3, slice(0, 3)),
    "bgr8": (3, slice(2, None, -1)),
    "rgba8": (4, slice(0, 3)),
    "bgra8": (4, slice(2, None, -1)),
    "mono8": (1, slice(0, 1)),
}


def decode(message: dict[str, Any]) -> Image:
    """The image of a sensor_msgs/Image. Raises a ValueError when it cannot be read."""
    encoding, width, height, step = (message[name] for name in ("encoding", "width", "height", "step"))
    if encoding not in _ENCODINGS:
        raise ValueError(f"its encoding is {encoding!r}; there can be read {', '.join(_ENCODINGS)}")
    channels, colours = _ENCODINGS[encoding]
    data = np.frombuffer(message["data"], np.uint8)
    if step < width * channels or data.size < height * step:
        raise ValueError(
            f"{width} x {height} pixels of {encoding} take a step of at least {width * channels} and height * step "
            f"bytes; its step is {step}, and it has {data.size} bytes"
        )
    rows = data[: height * step].reshape(height, step)[:, : width * channels]
    pixels = rows.reshape(height, width, channels)[:, :, colours]
    return np.broadcast_to(pixels, (height, width, 3))


def decompress(message: dict[str, Any]) -> Image:
    """The image of a sensor_msgs/CompressedImage. Raises a ValueError when it cannot be read."""
    cv2 = opencv()
    data = np.frombuffer(message["data"], np.uint8)
    try:
        image: Image | None = cv2.imdecode(data, cv2.IMREAD_COLOR)
    except cv2.error:  # no bytes at all, or more pixels than OpenCV takes
        image = None
    if image is None:
        raise ValueError(f"OpenCV cannot read its {data.size} bytes of format {message['format']!r}")
    return image[:, :, ::-1]


def compress(image: Image, image_format: str, level: int) -> Image:
    """The bytes of a file of a format of COMPRESSIONS."""
    cv2 = opencv()
    flag = {"jpeg": cv2.IMWRITE_JPEG_QUALITY, "png": cv2.IMWRITE_PNG_COMPRESSION}[image_format]
    _, data = cv2.imencode(f".{image_format}", cv2.cvtColor(image, cv2.COLOR_RGB2BGR), [flag, level])
    compressed: Image = data.reshape(-1)
    return compressed


def opencv() -> Any:
    """The module cv2, whose loading takes a while: only for who needs it."""
    try:
        import cv2
    except ImportError as error:
        raise ImportError(f"compressed images need OpenCV, Debian's package python3-opencv: {error}") from error
    return cv2
