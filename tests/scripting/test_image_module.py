# SPDX-License-Identifier: BSD-3-Clause
"""simIM: images, their pixels, operations and drawings."""

from pathlib import Path

from node_support import REFUSED, in_init, run_script

HEADER = f"""
simIM = require('simIM')
{REFUSED}"""


def check(folder: Path, body: str, scene: str = "ball", target: str = "/Ball") -> None:
    run = run_script(folder, f"{HEADER}{in_init(body)}", "--strict", scene=scene, target=target)
    assert (run.stderr, run.returncode) == ("", 0)


def test_pixels_are_set_and_read_from_the_top_left(tmp_path: Path) -> None:
    body = """
image = simIM.create(4, 3)
assert simIM.size(image) == [4, 3]
simIM.set(image, [3, 0], [10, 20, 30])
simIM.set(image, 0, 2, [1, 2, 3])  # the older form
assert simIM.get(image, [3, 0]) == [10, 20, 30] and simIM.get(image, 0, 2) == [1, 2, 3]
assert simIM.data(image)[9:12] == bytes([10, 20, 30])
assert 'is not a pixel' in refused(simIM.get, image, [4, 0])
simIM.destroy(image)
assert 'no image' in refused(simIM.size, image) and simIM.numActiveHandles() == 0
"""
    check(tmp_path, body)


def test_channels_are_split_merged_and_converted(tmp_path: Path) -> None:
    body = """
image = simIM.createFromData(2, 1, bytes([255, 0, 0, 0, 0, 255]))
red, green, blue = simIM.split(image)
assert simIM.get(red, [0, 0]) == [255] and simIM.get(blue, [1, 0]) == [255]
assert simIM.data(simIM.merge([red, green, blue])) == simIM.data(image)
# ITU-R BT.601: 0.299 R + 0.587 G + 0.114 B
grey = simIM.rgb2gray(image)
assert [simIM.get(grey, [x, 0])[0] for x in (0, 1)] == [76, 29]
hsv = simIM.rgb2hsv(image)
assert [round(n) for n in simIM.get(hsv, [0, 0])] == [0, 255, 255]
assert abs(simIM.get(hsv, [1, 0])[0] - 120) <= 1  # blue is at 240 degrees
assert simIM.get(simIM.hsv2rgb(hsv), [0, 0]) == [255, 0, 0]
"""
    check(tmp_path, body)


def test_operations_are_limited_to_a_byte_and_may_be_in_place(tmp_path: Path) -> None:
    body = """
one, two = simIM.create(1, 1, simIM.fmt_8UC1, 200), simIM.create(1, 1, simIM.fmt_8UC1, 100)
value = lambda image: simIM.get(image, [0, 0])[0]
assert value(simIM.add(one, two)) == 255 and value(simIM.subtract(two, one)) == 0
assert value(simIM.absdiff(two, one)) == 100 and value(simIM.divide(one, two)) == 2
assert value(simIM.addK(one, [-50])) == 150 and simIM.mean(one) == [200]
assert simIM.addK(one, [5], True) == one and value(one) == 205
floats = simIM.convert(one, simIM.fmt_32FC1, 0.5)
assert value(floats) == 102.5
assert 'different sizes' in refused(simIM.add, one, simIM.create(2, 2, simIM.fmt_8UC1))
"""
    check(tmp_path, body)


def test_drawings_have_their_colour_and_place(tmp_path: Path) -> None:
    body = """
image = simIM.create(32, 32)
simIM.rectangle(image, [2, 2], [6, 6], [255, 0, 0], -1)
simIM.circle(image, 20, 20, 4, 0, 255, 0, -1)  # the older form
simIM.line(image, [0, 31], [31, 31], [0, 0, 255])
simIM.fillConvexPoly(image, [20, 2, 28, 2, 28, 8], [9, 9, 9])
assert simIM.get(image, [4, 4]) == [255, 0, 0] and simIM.get(image, [20, 20]) == [0, 255, 0]
assert simIM.get(image, [15, 31]) == [0, 0, 255] and simIM.get(image, [26, 4]) == [9, 9, 9]
before = simIM.data(image)
simIM.text(image, 'A', [2, 28])
assert simIM.data(image) != before and simIM.textSize('AA')[0] > simIM.textSize('A')[0]
small = simIM.resize(image, 16, 16, simIM.interp_nearest)
assert simIM.size(small) == [16, 16] and simIM.get(small, [2, 2]) == [255, 0, 0]
"""
    check(tmp_path, body)


def test_a_camera_gives_its_image_and_takes_another_one(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            self.camera = sim.getObject('/visionSensor')
        def sysCall_sensing():
            if sim.getSimulationTime() < 0.1:
                return
            simIM = require('simIM')
            image = simIM.readFromVisionSensor(self.camera)
            width, height = sim.getVisionSensorRes(self.camera)
            assert simIM.size(image) == [width, height]
            data, _ = sim.getVisionSensorImg(self.camera)
            assert simIM.data(image)[:3 * width] == data[-3 * width:]  # the first row is the upper one
            simIM.rectangle(image, [0, 0], [width, height], [7, 8, 9], -1)
            simIM.writeToVisionSensor(image, self.camera)
            assert sim.getVisionSensorImg(self.camera)[0][:3] == bytes([7, 8, 9])
            simIM.destroy(image)
            print('seen')
    """
    run = run_script(tmp_path, code, "--strict", scene="p3dx_floor", target="/PioneerP3DX")
    assert run.stderr == ""
    assert "seen" in run.stdout


def test_hue_lightness_and_saturation_are_those_of_colorsys(tmp_path: Path) -> None:
    body = """
import colorsys
colours = [(255, 0, 0), (0, 255, 0), (10, 40, 200), (128, 128, 128), (250, 240, 30), (0, 0, 0), (255, 255, 255)]
image = simIM.createFromData(len(colours), 1, bytes(number for each in colours for number in each))
hls = simIM.rgb2hls(image)
back = simIM.hls2rgb(hls)
for x, colour in enumerate(colours):
    hue, lightness, saturation = colorsys.rgb_to_hls(*(number / 255 for number in colour))
    wanted = [180 * hue, 255 * lightness, 255 * saturation]
    assert all(abs(a - b) <= 0.5 for a, b in zip(simIM.get(hls, [x, 0]), wanted)), colour
    assert all(abs(a - b) <= 5 for a, b in zip(simIM.get(back, [x, 0]), colour))  # a hue counts two degrees
"""
    check(tmp_path, body)


def test_images_are_mirrored_repeated_weighed_and_masked(tmp_path: Path) -> None:
    body = """
image = simIM.createFromData(2, 1, bytes([1, 9]), simIM.fmt_8UC1)
numbers = lambda image: list(simIM.data(image))
assert numbers(simIM.flip(image, 1)) == [9, 1] and numbers(simIM.flip(image, 0)) == [1, 9]
assert numbers(simIM.repeat(image, 2, 2)) == [1, 9, 1, 9] * 2
assert numbers(simIM.addWeighted(image, image, 2, 3, 4)) == [9, 49]
assert numbers(simIM.scaleAdd(image, 2, image)) == [3, 27]
assert numbers(simIM.pow(image, 2)) == [1, 81] and numbers(simIM.sqrt(image)) == [1, 3]
assert numbers(simIM.exp(image)) == [3, 255] and numbers(simIM.log(image)) == [0, 2]
assert numbers(simIM.divideK(image, [2])) == [0, 4] and numbers(simIM.bitwiseAndK(image, [8])) == [0, 8]
assert numbers(simIM.bitwiseOr(image, simIM.create(2, 1, simIM.fmt_8UC1, 2))) == [3, 11]
assert numbers(simIM.bitwiseXor(image, image)) == [0, 0] and numbers(simIM.bitwiseNot(image)) == [254, 246]
assert 'formats with integers' in refused(simIM.bitwiseNot, simIM.convert(image, simIM.fmt_32FC1))
"""
    check(tmp_path, body)


def test_operations_with_numbers_and_bits(tmp_path: Path) -> None:
    body = """
one, two = simIM.create(1, 1, simIM.fmt_8UC1, 12), simIM.create(1, 1, simIM.fmt_8UC1, 10)
value = lambda image: simIM.get(image, [0, 0])[0]
assert value(simIM.bitwiseAnd(one, two)) == 8
assert value(simIM.bitwiseOrK(one, [3])) == 15 and value(simIM.bitwiseXorK(one, [10])) == 6
assert value(simIM.absdiffK(one, [20])) == 8 and value(simIM.subtractK(one, [5])) == 7
assert value(simIM.subtractK(one, [20])) == 0
assert value(simIM.greaterThanK(one, [11])) == 255 and value(simIM.greaterThanK(one, [12])) == 0
assert value(simIM.lessThanK(one, [13])) == 255 and value(simIM.lessThanK(one, [12])) == 0
assert simIM.get(simIM.gray2rgb(one), [0, 0]) == [12, 12, 12]
assert simIM.writeToTexture(one, 0) is None
"""
    check(tmp_path, body)


def test_lines_areas_and_arcs_are_drawn(tmp_path: Path) -> None:
    body = """
image = simIM.create(9, 9)
simIM.polylines(image, [1, 1, 7, 1, 7, 7], [3], False, [255, 0, 0], 1)
assert simIM.get(image, [4, 1]) == simIM.get(image, [7, 4]) == [255, 0, 0] and simIM.get(image, [4, 4]) == [0, 0, 0]
simIM.fillPoly(image, [2, 2, 6, 2, 6, 6, 2, 6], [4], [0, 0], [0, 255, 0])
assert simIM.get(image, [4, 4]) == [0, 255, 0] and simIM.get(image, [0, 8]) == [0, 0, 0]
simIM.ellipse(image, [4, 4], [3, 3], 0, 0, 360, [0, 0, 255], 1)
assert simIM.get(image, [4, 1]) == simIM.get(image, [1, 4]) == [0, 0, 255]
"""
    check(tmp_path, body)
