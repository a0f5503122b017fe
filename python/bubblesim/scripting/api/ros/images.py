# SPDX-License-Identifier: BSD-3-Clause
"""`simROS` functions for images."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from bubblesim.scripting.api.ros.image_codec import COMPRESSIONS, Image, compress, decode, decompress, opencv
from bubblesim.scripting.api.ros.kinds import Pixels, RosHandle
from bubblesim.scripting.api.ros.parameters import RosParameters
from bubblesim.scripting.api.ros.stamps import now
from bubblesim.scripting.api.ros.topics import RosTopics
from bubblesim.scripting.caller import Caller

_RAW, _COMPRESSED = "sensor_msgs/Image", "sensor_msgs/CompressedImage"

ImageCallback = Callable[[bytes, int, int], object] | str


class RosImages(RosTopics, RosParameters):
    """Images in scripts are rgb8 bytes without padding, with rows from bottom to top, as in `sim`.

    They are published raw on their topic, and compressed on topic/compressed if it has subscribers. The parameters
    topic/compressed/format ('jpeg' or 'png'), .../jpeg_quality (1 to 100) and .../png_level (1 to 9), which are those
    of compressed_image_transport, are read when the publisher is created.
    """

    def __init__(self, bridge: Any, simulation: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        super().__init__(bridge, simulation, caller)
        self._compressed: dict[int, tuple[int, str, int]] = {}  # by raw publisher: publisher, format, level

    def imageTransportPublish(self, publisher: RosHandle, data: Pixels, width: int, height: int, frame_id: str) -> None:
        """Publish an image given as bytes or a numpy array of uint8, stamped with getTime.

        Raises a ValueError if it does not hold width * height * 3 bytes.
        """
        compressed, image_format, level = self._compressed_of(publisher)
        rows = _rows(data, width, height)
        raw_wanted = self._bridge.wants_messages(publisher)
        compressed_wanted = self._bridge.wants_messages(compressed)
        if not raw_wanted and not compressed_wanted:
            return
        top_down = np.ascontiguousarray(rows[::-1])
        header = {"stamp": now(self._bridge), "frame_id": frame_id}
        if raw_wanted:
            size = {"width": width, "height": height, "step": width * 3}
            message = {"header": header, "encoding": "rgb8", "data": top_down.reshape(-1), **size}
            self._bridge.publish(publisher, message)
        if compressed_wanted:
            # The format string is that of compressed_image_transport; decoders read the channels from it.
            message = {"header": header, "format": f"rgb8; {image_format} compressed bgr8"}
            self._bridge.publish(compressed, message | {"data": compress(top_down, image_format, level)})

    def wantsMessages(self, publisher: RosHandle) -> bool:
        """Return whether the topic has subscribers; always true for a topic that keeps messages for late ones.

        For images, also whether the compressed topic has subscribers.
        """
        compressed = self._compressed.get(publisher)
        return super().wantsMessages(publisher) or (
            compressed is not None and bool(self._bridge.wants_messages(compressed[0]))
        )

    def imageTransportShutdownPublisher(self, publisher: RosHandle) -> None:
        """Stop publishing images; the handle becomes invalid."""
        compressed, _, _ = self._compressed_of(publisher)
        del self._compressed[publisher]
        self.shutdownPublisher(compressed)
        self.shutdownPublisher(publisher)

    def _advertise_images(self, topic: str, queue_size: int) -> int:
        publisher = self._advertise(topic, _RAW, queue_size)
        compressed_topic = f"{topic.rstrip('/')}/compressed"
        image_format, level = self._compression(compressed_topic)
        self._compressed[publisher] = (
            self._advertise(compressed_topic, _COMPRESSED, queue_size),
            image_format,
            level,
        )
        return publisher

    def _subscribe_images(self, topic: str, callback: ImageCallback, queue_size: int, transport: str) -> int:
        guarded = self._caller.callback(callback)
        if transport == "raw":
            return self._subscribe(topic, _RAW, self._deliver(topic, decode, guarded), queue_size)
        if transport == "compressed":
            opencv()  # so that a missing module is reported in the script
            topic = f"{topic.rstrip('/')}/compressed"
            return self._subscribe(topic, _COMPRESSED, self._deliver(topic, decompress, guarded), queue_size)
        raise ValueError(f"transport must be 'raw' or 'compressed', found {transport!r}")

    def _compression(self, compressed_topic: str) -> tuple[str, int]:
        image_format = self.getParamString(f"{compressed_topic}/format", "jpeg")[1]
        if image_format not in COMPRESSIONS:
            takes = " or ".join(f"'{name}'" for name in COMPRESSIONS)
            self._warn(f"parameter '{compressed_topic}/format' must be {takes}, found {image_format!r}: using 'jpeg'")
            image_format = "jpeg"
        parameter, levels, default = COMPRESSIONS[image_format]
        level = self.getParamInt(f"{compressed_topic}/{parameter}", default)[1]
        if level not in levels:
            takes = f"{levels.start} to {levels.stop - 1}"
            self._warn(f"parameter '{compressed_topic}/{parameter}' must be {takes}, found {level}: using {default}")
            level = default
        return image_format, level

    def _compressed_of(self, publisher: int) -> tuple[int, str, int]:
        if publisher not in self._compressed:
            raise ValueError(f"invalid object handle {publisher}: no such image publisher, or it was shut down")
        return self._compressed[publisher]

    def _deliver(
        self, topic: str, read: Callable[[dict[str, Any]], Image], guarded: Callable[..., None]
    ) -> Callable[[dict[str, Any]], None]:
        def deliver(message: dict[str, Any]) -> None:
            try:
                image = read(message)
            except ValueError as error:  # an error of the sender, which does not end the script
                self._warn(f"an image on '{topic}' is ignored: {error}")
                return
            height, width, _ = image.shape
            guarded(image[::-1].tobytes(), width, height)

        return deliver


def _rows(data: Image, width: int, height: int) -> Image:
    """Return the image as an array of height x width x 3, without a copy."""
    if width < 1 or height < 1 or data.size != width * height * 3:
        raise ValueError(
            f"an image of {width} x {height} pixels needs {width} * {height} * 3 = {width * height * 3} bytes of rgb8 "
            f"and at least one pixel; found {data.size} bytes"
        )
    return data.reshape(height, width, 3)
