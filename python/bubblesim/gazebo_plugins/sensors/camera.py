# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_camera: a camera's pictures and optics."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

from bubblesim._core import camera_optics, read_camera
from bubblesim.gazebo_plugins.device import Device, Message, PluginContext
from bubblesim.gazebo_plugins.sensors.camera_info import CameraInfo
from bubblesim.gazebo_plugins.sensors.readings import NewReadings
from bubblesim.scripting.api.ros.image_codec import COMPRESSIONS, compress

_QUEUE_SIZE = 2


class Camera(Device):
    """Parameters, topics and defaults are those of gazebo_ros_pkgs; a compressed topic lies below the picture's."""

    image_topic = "image_raw"
    info_topic = "camera_info"

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self.frame_id = self.frame(p.text("frameName", "/world"))
        self.info = CameraInfo(p)
        self._images = NewReadings(self, read_camera, p.number("updateRate", 0.0, least=0.0))
        image = self.below_camera(p.text("imageTopicName", self.image_topic))
        info = self.below_camera(p.text("cameraInfoTopicName", self.info_topic))
        p.check()
        self._image = self.advertise(image, "sensor_msgs/Image", _QUEUE_SIZE)
        self._compressed: int | None = None
        if find_spec("cv2") is not None:  # Debian's python3-opencv, which compresses
            self._compressed = self.advertise(f"{image}/compressed", "sensor_msgs/CompressedImage", _QUEUE_SIZE)
        self.infos = [self.advertise(info, "sensor_msgs/CameraInfo", _QUEUE_SIZE)]
        self._pictures = [self._image] if self._compressed is None else [self._image, self._compressed]

    def below_camera(self, name: str) -> str:
        """A topic in the namespace that the camera's name makes."""
        camera = self.parameters.text("cameraName", "").strip("/")
        return name if name.startswith("/") or not camera else f"{camera}/{name}"

    def advertise_more(self, topic: str, message_type: str) -> int:
        """A further topic of the same camera, listeners to which have it measure."""
        publisher = self.advertise(self.below_camera(topic), message_type, _QUEUE_SIZE)
        self._pictures.append(publisher)
        return publisher

    def advertise_more_infos(self, topic: str) -> None:
        """A further topic that tells of the optics."""
        self.infos.append(self.advertise(self.below_camera(topic), "sensor_msgs/CameraInfo", _QUEUE_SIZE))

    def reset(self) -> None:
        """Start over."""
        self._images.reset()

    def publish(self) -> None:
        """Publish a new picture, and with it the optics; the optics alone do not have the camera measure."""
        pictures, infos = (any(map(self.wanted, topics)) for topics in (self._pictures, self.infos))
        if not (pictures or infos) or not self._images.due():
            return
        header = self.header(self.frame_id)
        if pictures:
            self.tell(read_camera(self.simulation, self.context.owner), header)
        if infos:
            self._publish_infos(header)

    def _publish_infos(self, header: Message) -> None:
        info = {"header": header, **self.info.message(*camera_optics(self.simulation, self.context.owner))}
        for publisher in filter(self.wanted, self.infos):
            self.bridge.publish(publisher, info)

    def tell(self, image: Any, header: Message) -> None:
        """Publish of the picture what somebody listens to."""
        if image.rgb is not None:
            if self.wanted(self._image):
                self.bridge.publish(self._image, {"header": header, **image_message(image.rgb, "rgb8")})
            if self._compressed is not None and self.wanted(self._compressed):
                data = compress(image.rgb, "jpeg", COMPRESSIONS["jpeg"][2])
                message = {"header": header, "format": "rgb8; jpeg compressed bgr8", "data": data}
                self.bridge.publish(self._compressed, message)


def image_message(pixels: Any, encoding: str) -> Message:
    """A sensor_msgs/Image without its header, of an array of rows, which is copied once, into the message."""
    height, width = pixels.shape[:2]
    return {
        "height": height,
        "width": width,
        "encoding": encoding,
        "is_bigendian": 0,
        "step": pixels.nbytes // height,
        "data": pixels.view("u1") if pixels.dtype != "u1" else pixels,
    }
