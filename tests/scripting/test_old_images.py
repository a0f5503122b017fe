# SPDX-License-Identifier: BSD-3-Clause
"""Images of cameras in the forms of older versions, image files, and conversions of buffers."""

from pathlib import Path

from node_support import in_init, run_script

HEADER = """
import math
import struct
import numpy as np
near = lambda a, b, tolerance=1e-6: np.testing.assert_allclose(a, b, atol=tolerance)
"""


def check(folder: Path, body: str) -> None:
    code = HEADER + in_init(body)
    run = run_script(folder, code, "--strict", scene="tricycle", target="/Tricycle", until=0.05)
    assert (run.stderr, run.returncode) == ("", 0)


def test_a_camera_answers_in_the_forms_of_older_versions(tmp_path: Path) -> None:
    body = """
wall = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.1, 9, 9])
sim.setShapeColor(wall, None, sim.colorcomponent_ambient_diffuse, [1, 0, 0])
sim.setObjectPosition(wall, [22.05, 0, 50])
eye = sim.createVisionSensor(2, [8, 4, 0, 0], [0.5, 10, 0.5, 0.1, 0.1, 0.1, 0, 0, 0, 0, 0])
sim.setObjectPose(eye, [20, 0, 50, 0, math.sqrt(0.5), 0, math.sqrt(0.5)])
sim.handleVisionSensor(eye)
assert sim.getVisionSensorResolution(eye) == [8, 4]
image = sim.getVisionSensorImage(eye)
data = sim.getVisionSensorImg(eye)[0]
near(image, np.frombuffer(data, np.uint8) / 255)
assert sim.getVisionSensorImage(eye, 0, 0, 0, 0, 1) == data
near(sim.getVisionSensorImage(eye, 2, 1, 3, 2), np.reshape(image, (4, 8, 3))[1:3, 2:5].ravel())
assert len(sim.getVisionSensorImage(eye + sim.handleflag_greyscale)) == 32
share = (2 - 0.5) / (10 - 0.5)  # the wall is at 2 m
near(sim.getVisionSensorDepthBuffer(eye), [share] * 32, 1e-3)
near(sim.getVisionSensorDepthBuffer(eye + sim.handleflag_depthbuffermeters), [2] * 32, 1e-3)
packed = sim.getVisionSensorDepthBuffer(eye + sim.handleflag_codedstring)
near(struct.unpack('32f', packed), [share] * 32, 1e-3)
sim.setVisionSensorImage(eye, [0.2] * 96)
near(sim.getVisionSensorImage(eye), [0.2] * 96, 0.003)
"""
    check(tmp_path, body)


def test_an_image_is_written_and_read(tmp_path: Path) -> None:
    body = f"""
pixels = np.random.default_rng(1).integers(0, 256, (3, 5, 3), dtype=np.uint8).tobytes()
file = sim.saveImage(pixels, [5, 3], 0, '.png')
assert sim.loadImage(0, file) == (pixels, [5, 3])
sim.saveImage(pixels, [5, 3], 0, '{tmp_path}/image.png')
assert sim.loadImage(0, '{tmp_path}/image.png') == (pixels, [5, 3])
data, size = sim.loadImage(1, file)
assert size == [5, 3] and len(data) == 60 and data[:3] == pixels[:3]
beside = sim.combineRgbImages(pixels, [5, 3], pixels, [5, 3], 0)
assert len(beside) == 90 and beside[:15] == beside[15:30] == pixels[:15]
assert sim.combineRgbImages(pixels, [5, 3], pixels, [5, 3], 1) == 2 * pixels
"""
    check(tmp_path, body)


def test_a_buffer_is_scaled_and_converted(tmp_path: Path) -> None:
    body = """
floats = sim.transformBuffer(bytes([0, 100, 200]), sim.buffer_uint8, 0.5, 1, sim.buffer_float)
near(struct.unpack('3f', floats), [1, 51, 101])
assert sim.transformBuffer(floats, sim.buffer_float, 2, -2, sim.buffer_uint8) == bytes([0, 100, 200])
"""
    check(tmp_path, body)


def test_an_entity_gets_a_colour_and_its_own_one_again(tmp_path: Path) -> None:
    body = """
box = sim.createPureShape(0, 8, [0.1, 0.1, 0.1], 1)
sim.setShapeColor(box, None, sim.colorcomponent_ambient_diffuse, [0, 1, 0])
before = sim.changeEntityColor(box, [1, 0, 0])
near(sim.getShapeColor(box, None, sim.colorcomponent_ambient_diffuse)[1], [1, 0, 0])
sim.restoreEntityColor(before)
near(sim.getShapeColor(box, None, sim.colorcomponent_ambient_diffuse)[1], [0, 1, 0])
"""
    check(tmp_path, body)
