# SPDX-License-Identifier: BSD-3-Clause
"""`simROS` functions about images."""

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
    """Images in scripts are rgb8 bytes without padding whose rows go from the bottom up, as those of `sim` do.

    They are published raw on their topic, and compressed on topic/compressed while somebody listens there. The
    parameters topic/compressed/format ('jpeg' or 'png'), .../jpeg_quality (1 to 100) and .../png_level (1 to 9), which
    compressed_image_transport has, too, are read when the publisher is made.
    """

    def __init__(self, bridge: Any, simulation: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        super().__init__(bridge, simulation, caller)
        self._compressed: dict[int, tuple[int, str, int]] = {}  # by raw publisher: publisher, format, level

    def imageTransportPublish(self, publisher: RosHandle, data: Pixels, width: int, height: int, frame_id: str) -> None:
        """Publish an image given as bytes or a numpy array of uint8, stamped with ROS time.

        Raises a ValueError when it does not hold width * height * 3 bytes.
        """
        compressed, image_format, level = self._compressed_beside(publisher)
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
            # The format is written as compressed_image_transport does: whoever decodes learns the channels from it.
            message = {"header": header, "format": f"rgb8; {image_format} compressed bgr8"}
            self._bridge.publish(compressed, message | {"data": compress(top_down, image_format, level)})

    def wantsMessages(self, publisher: RosHandle) -> bool:
        """Whether somebody listens, so that a message is worth making; always for a latched topic.

        Of images, also to the compressed ones.
        """
        compressed = self._compressed.get(publisher)
        return super().wantsMessages(publisher) or (
            compressed is not None and bool(self._bridge.wants_messages(compressed[0]))
        )

    def imageTransportShutdownPublisher(self, publisher: RosHandle) -> None:
        """Stop publishing images; the handle cannot be used any more."""
        compressed, _, _ = self._compressed_beside(publisher)
        del self._compressed[publisher]
        self.shutdownPublisher(compressed)
        self.shutdownPublisher(publisher)

    def _advertise_images(self, topic: str, queue_size: int) -> int:
        publisher = self._advertise(topic, _RAW, queue_size, latch=False)
        beside = f"{topic.rstrip('/')}/compressed"
        image_format, level = self._compression(beside)
        self._compressed[publisher] = (
            self._advertise(beside, _COMPRESSED, queue_size, latch=False),
            image_format,
            level,
        )
        return publisher

    def _subscribe_images(self, topic: str, callback: ImageCallback, queue_size: int, transport: str) -> int:
        guarded = self._caller.callback(callback)
        if transport == "raw":
            return self._listen(topic, _RAW, self._deliver(topic, decode, guarded), queue_size)
        if transport == "compressed":
            opencv()  # so that it is missed here, in the script
            topic = f"{topic.rstrip('/')}/compressed"
            return self._listen(topic, _COMPRESSED, self._deliver(topic, decompress, guarded), queue_size)
        raise ValueError(f"transport takes 'raw' or 'compressed', found {transport!r}")

    def _compression(self, beside: str) -> tuple[str, int]:
        image_format = self.getParamString(f"{beside}/format", "jpeg")[1]
        if image_format not in COMPRESSIONS:
            takes = " or ".join(f"'{name}'" for name in COMPRESSIONS)
            self._warn(f"parameter '{beside}/format' takes {takes}, found {image_format!r}: 'jpeg' is used")
            image_format = "jpeg"
        parameter, levels, default = COMPRESSIONS[image_format]
        level = self.getParamInt(f"{beside}/{parameter}", default)[1]
        if level not in levels:
            takes = f"{levels.start} to {levels.stop - 1}"
            self._warn(f"parameter '{beside}/{parameter}' takes {takes}, found {level}: {default} is used")
            level = default
        return image_format, level

    def _compressed_beside(self, publisher: int) -> tuple[int, str, int]:
        if publisher not in self._compressed:
            raise ValueError(f"invalid object handle {publisher}: no such image publisher, or it was shut down")
        return self._compressed[publisher]

    def _deliver(
        self, topic: str, read: Callable[[dict[str, Any]], Image], guarded: Callable[..., None]
    ) -> Callable[[dict[str, Any]], None]:
        def deliver(message: dict[str, Any]) -> None:
            try:
                image = read(message)
            except ValueError as error:  # the fault of whoever sent it: no reason to end the script
                self._warn(f"an image on '{topic}' is left out: {error}")
                return
            height, width, _ = image.shape
            guarded(image[::-1].tobytes(), width, height)

        return deliver


def _rows(data: Image, width: int, height: int) -> Image:
    """The image as an array of height x width x 3, without a copy."""
    if width < 1 or height < 1 or data.size != width * height * 3:
        raise ValueError(
            f"an image of {width} x {height} pixels takes {width} * {height} * 3 = {width * height * 3} bytes of rgb8, "
            f"and at least one pixel; found {data.size} bytes"
        )
    return data.reshape(height, width, 3)
