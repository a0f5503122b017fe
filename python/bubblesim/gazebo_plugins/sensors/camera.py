# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_camera: images and camera info."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

from bubblesim._core import camera_optics, read_camera
from bubblesim._core.reading_messages import color_image, compressed_image
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext
from bubblesim.gazebo_plugins.sensors.camera_info import CameraInfo
from bubblesim.gazebo_plugins.sensors.readings import NewReadings
from bubblesim.scripting.api.ros.image_codec import COMPRESSIONS, compress

_QUEUE_SIZE = 2


class Camera(Plugin):
    """Parameters, topics and defaults are those of gazebo_ros_pkgs; the compressed topic is IMAGE/compressed."""

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
        if find_spec("cv2") is not None:  # Debian's python3-opencv, used for compression
            self._compressed = self.advertise(f"{image}/compressed", "sensor_msgs/CompressedImage", _QUEUE_SIZE)
        self.infos = [self.advertise(info, "sensor_msgs/CameraInfo", _QUEUE_SIZE)]
        self._pictures = [self._image] if self._compressed is None else [self._image, self._compressed]

    def below_camera(self, name: str) -> str:
        """Return a topic in the namespace of the camera's name."""
        camera = self.parameters.text("cameraName", "").strip("/")
        return name if name.startswith("/") or not camera else f"{camera}/{name}"

    def advertise_more(self, topic: str, message_type: str) -> int:
        """Advertise another topic of the camera; its subscribers trigger rendering."""
        publisher = self.advertise(self.below_camera(topic), message_type, _QUEUE_SIZE)
        self._pictures.append(publisher)
        return publisher

    def advertise_more_infos(self, topic: str) -> None:
        """Advertise another sensor_msgs/CameraInfo topic."""
        self.infos.append(self.advertise(self.below_camera(topic), "sensor_msgs/CameraInfo", _QUEUE_SIZE))

    def reset(self) -> None:
        """Reset the state."""
        self._images.reset()

    def publish(self) -> None:
        """Publish a new image and its camera info; subscribers of the info alone do not trigger rendering."""
        pictures, infos = (any(map(self.is_needed, topics)) for topics in (self._pictures, self.infos))
        if not (pictures or infos) or not self._images.due():
            return
        header = self.header(self.frame_id)
        if pictures:
            self.publish_image(read_camera(self.simulation, self.context.owner), header)
        if infos:
            self._publish_infos(header)

    def _publish_infos(self, header: Any) -> None:
        info = self.info.message(header, *camera_optics(self.simulation, self.context.owner))
        for publisher in filter(self.is_needed, self.infos):
            self.bridge.publish(publisher, info)

    def publish_image(self, image: Any, header: Any) -> None:
        """Publish the topics of the image that have subscribers."""
        if image.rgb is not None:
            if self.is_needed(self._image):
                self.bridge.publish(self._image, color_image(header, image))
            if self._compressed is not None and self.is_needed(self._compressed):
                data = compress(image.rgb, "jpeg", COMPRESSIONS["jpeg"][2])
                message = compressed_image(header, "rgb8; jpeg compressed bgr8", data)
                self.bridge.publish(self._compressed, message)
