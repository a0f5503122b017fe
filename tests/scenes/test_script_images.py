# SPDX-License-Identifier: BSD-3-Clause
"""simROS.imageTransport* in child scripts, with rospy and cv_bridge."""

import re
import subprocess
from collections.abc import Callable

import numpy as np

from node_support import Node
from ros_support import DEADLINE, RosCore, start, stop, wait_until

Script = Callable[[str], Node]

# 64 x 32 pixels in four fields: red and green above, blue and yellow below; scripts pass the bottom row first.
PUBLISH = """\
import sys
RED, GREEN, BLUE, YELLOW = b'\\xff\\0\\0', b'\\0\\xff\\0', b'\\0\\0\\xff', b'\\xff\\xff\\0'
IMAGE = (BLUE * 32 + YELLOW * 32) * 16 + (RED * 32 + GREEN * 32) * 16
def sysCall_init():
    self.camera = simROS.imageTransportAdvertise('/camera')
def sysCall_sensing():
    simROS.imageTransportPublish(self.camera, IMAGE, 64, 32, 'lens')
def sysCall_cleanup():
    print('OpenCV is loaded:', 'cv2' in sys.modules)
"""
FIELDS = np.repeat(np.repeat([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 0]]], 16, axis=0), 32, axis=1)

OBSERVE = """
import rospy, cv_bridge, sys
from sensor_msgs.msg import CompressedImage, Image
rospy.init_node('observer')
topic = sys.argv[1]
message = rospy.wait_for_message(topic, CompressedImage if topic.endswith('compressed') else Image, 20)
bridge = cv_bridge.CvBridge()
read = bridge.compressed_imgmsg_to_cv2 if topic.endswith('compressed') else bridge.imgmsg_to_cv2
assert message.header.frame_id == 'lens' and abs(message.header.stamp.to_sec() - rospy.get_time()) < 60
image = read(message, 'rgb8')
print(getattr(message, 'format', message._type), image.shape[0], image.shape[1], image.tobytes().hex(), sep=',')
"""


def observe(core: RosCore, topic: str) -> tuple[str, np.ndarray[tuple[int, ...], np.dtype[np.int64]]]:
    """Return an image on a topic from cv_bridge: its format, and its pixels as rgb8 with the top row first."""
    command = ["/usr/bin/python3", "-c", OBSERVE, topic]
    seen = subprocess.run(command, env=core.env, capture_output=True, text=True, timeout=4 * DEADLINE, check=False)
    assert seen.returncode == 0, seen.stderr
    name, height, width, pixels = seen.stdout.strip().split(",")
    return name, np.frombuffer(bytes.fromhex(pixels), np.uint8).reshape(int(height), int(width), 3).astype(np.int64)


def test_raw_images_have_their_top_row_first_and_nothing_is_compressed_for_nobody(
    script: Script, roscore: RosCore
) -> None:
    node = script(PUBLISH)
    np.testing.assert_array_equal(observe(roscore, "/camera")[1], FIELDS)
    assert node.end() == 0
    assert "OpenCV is loaded: False" in node.output


def test_compressed_images_are_jpeg_by_default(script: Script, roscore: RosCore) -> None:
    script(PUBLISH)
    image_format, pixels = observe(roscore, "/camera/compressed")
    assert image_format == "rgb8; jpeg compressed bgr8"
    # JPEG stores colours at half the resolution: they blend at the edges of the fields only.
    inside = np.ones((32, 64), bool)
    inside[14:18, :] = inside[:, 30:34] = False
    np.testing.assert_allclose(pixels[inside], FIELDS[inside], atol=8)


def test_compressed_images_are_png_where_the_parameter_asks_for_it(script: Script, roscore: RosCore) -> None:
    roscore.set_param("/camera/compressed/format", "png")
    roscore.set_param("/camera/compressed/png_level", 11)
    node = script(PUBLISH)
    image_format, pixels = observe(roscore, "/camera/compressed")
    assert image_format == "rgb8; png compressed bgr8"
    np.testing.assert_array_equal(pixels, FIELDS)
    assert "parameter '/camera/compressed/png_level' must be 1 to 9, found 11: using 9" in node.output


# A red pixel left of a green one, above a blue one left of a white one; two bytes of padding per row.
SEND = """
import numpy as np, rospy, cv_bridge
from sensor_msgs.msg import CompressedImage, Image
rospy.init_node('camera')
R, G, B, W = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)
rgb = np.array([[R, G], [B, W]], np.uint8)
alpha = np.full((2, 2, 1), 7, np.uint8)
bgr = rgb[:, :, ::-1]
images = {'rgb8': rgb, 'bgr8': bgr, 'rgba8': np.dstack([rgb, alpha]), 'bgra8': np.dstack([bgr, alpha]),
          'mono8': np.array([[[1], [2]], [[3], [4]]], np.uint8)}
publishers = []
def send(topic, message):
    publishers.append(rospy.Publisher(topic, type(message), latch=True, queue_size=1))
    publishers[-1].publish(message)
for encoding, image in images.items():
    data = b''.join(row.tobytes() + b'xx' for row in image)
    send('/' + encoding, Image(encoding=encoding, width=2, height=2, step=len(data) // 2, data=data))
send('/deep', Image(encoding='16UC1', width=1, height=1, step=2, data=b'xx'))
send('/short', Image(encoding='rgb8', width=2, height=2, step=6, data=b'xx'))
send('/png/compressed', cv_bridge.CvBridge().cv2_to_compressed_imgmsg(bgr, 'png'))
send('/broken/compressed', CompressedImage(format='jpeg', data=b'xx'))
rospy.spin()
"""


def test_the_quality_of_jpeg_is_that_of_the_parameter_and_arrays_are_images(script: Script, roscore: RosCore) -> None:
    roscore.set_param("/coarse/compressed/jpeg_quality", 1)
    node = script("""\
        import numpy as np
        NOISE = np.random.default_rng(0).integers(0, 256, (32, 64, 3), np.uint8)
        def sysCall_init():
            self.cameras = [simROS2.imageTransportCreatePublisher(topic) for topic in ('/fine', '/coarse')]
            for topic in ('/fine', '/coarse'):
                simROS.subscribe(topic + '/compressed', 'sensor_msgs/CompressedImage', receive_size(topic))
            simROS2.imageTransportCreateSubscription('/fine', receive, 1, 'compressed')
        def sysCall_sensing():
            for camera in self.cameras:
                simROS2.imageTransportPublish(camera, NOISE, 64, 32, 'lens')
        def receive_size(topic):
            return lambda message: print(topic, len(message['data']))
        def receive(data, width, height):
            error = np.abs(np.frombuffer(data, np.uint8).reshape(32, 64, 3).mean() - NOISE.mean())
            print('received', width, height, error < 5)
        """)
    node.wait_for_output("received 64 32 True")
    sizes: dict[str, int] = {}
    for topic in ("/fine", "/coarse"):
        wait_until(lambda topic=topic: size(node, topic) is not None, f"an image on {topic}")
        sizes[topic] = size(node, topic) or 0
    assert sizes["/coarse"] < sizes["/fine"] / 2


def size(node: Node, topic: str) -> int | None:
    """Return the first size that the script has printed; it prints a line in pieces."""
    found = re.search(rf"^{topic} (\d+)\n", node.output, re.MULTILINE)
    return int(found[1]) if found else None


def test_images_of_all_encodings_arrive_as_rgb8_with_the_bottom_row_first(script: Script, roscore: RosCore) -> None:
    node = script("""\
        def receive(name):
            return lambda data, width, height: print('received', name, width, height, data.hex())
        def sysCall_init():
            for name in ('rgb8', 'bgr8', 'rgba8', 'bgra8', 'mono8', 'deep', 'short'):
                simROS.imageTransportSubscribe('/' + name, receive(name))
            for name in ('png', 'broken'):
                simROS.imageTransportSubscribe('/' + name, receive(name), 1, 'compressed')
        """)
    camera = start(["/usr/bin/python3", "-c", SEND], roscore.env)
    try:
        for name in ("rgb8", "bgr8", "rgba8", "bgra8", "png"):
            node.wait_for_output(f"received {name} 2 2 " + "0000ff" + "ffffff" + "ff0000" + "00ff00")
        node.wait_for_output("received mono8 2 2 " + "030303" + "040404" + "010101" + "020202")
        node.wait_for_output("'/deep' is ignored: unsupported encoding '16UC1'; supported: rgb8, bgr8, rgba8")
        node.wait_for_output("'/short' is ignored: 2 x 2 pixels of rgb8 need")
        node.wait_for_output("'/broken/compressed' is ignored: OpenCV cannot decode 2 bytes of format 'jpeg'")
    finally:
        stop(camera)


def test_wrong_images_and_stale_handles_are_reported(script: Script) -> None:
    node = script("""\
        import numpy as np
        def reported(call, *arguments):
            try:
                call(*arguments)
            except (TypeError, ValueError) as error:
                print('reported:', error)
        def sysCall_init():
            camera = simROS.imageTransportAdvertise('/camera')
            reported(simROS.imageTransportPublish, camera, bytes(11), 2, 2, 'lens')
            reported(simROS.imageTransportPublish, camera, bytes(12), 2, 2, 5)
            reported(simROS.imageTransportPublish, camera, np.zeros(12), 2, 2, 'lens')
            reported(simROS.imageTransportSubscribe, '/camera', print, 1, 'theora')
            simROS.imageTransportShutdownPublisher(camera)
            reported(simROS.imageTransportPublish, camera, bytes(12), 2, 2, 'lens')
            reported(simROS.imageTransportShutdownPublisher, camera)
            listener = simROS.imageTransportSubscribe('/camera', print)
            simROS.imageTransportShutdownSubscriber(listener)
            reported(simROS.imageTransportShutdownSubscriber, listener)
            print('done')
        """)
    node.wait_for_output("done")
    assert "needs 2 * 2 * 3 = 12 bytes of rgb8 and at least one pixel; found 11 bytes" in node.output
    assert "argument 5, frame_id: expected a string, found int 5" in node.output
    assert "argument 2, data: expected bytes or a numpy array of uint8, found an array of float64" in node.output
    assert "transport must be 'raw' or 'compressed', found 'theora'" in node.output
    assert node.output.count("reported: invalid object handle") == 3


def test_image_topics_end_with_their_script(script: Script, roscore: RosCore) -> None:
    node = script("""\
        def sysCall_init():
            simROS.imageTransportAdvertise('/camera')
            simROS.imageTransportSubscribe('/end', lambda data, width, height: None)
            simROS.subscribe('/end_now', 'std_msgs/Empty', lambda message: 1 / 0)
        """)
    topics = {"/camera", "/camera/compressed"}
    wait_until(lambda: topics <= roscore.state()["publishers"].keys(), "the publishers")
    wait_until(lambda: "/end_now" in roscore.state()["subscribers"], "the subscribers")
    with roscore.publishing("/end_now", "std_msgs/Empty"):
        node.wait_for_output("is disabled")
    wait_until(lambda: not topics & roscore.state()["publishers"].keys(), "the publishers to go")
    wait_until(lambda: "/end" not in roscore.state()["subscribers"], "the subscriber to go")
