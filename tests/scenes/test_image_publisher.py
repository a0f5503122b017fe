# SPDX-License-Identifier: BSD-3-Clause
"""The camera that publishes its images, and the panel that shows them."""

from pathlib import Path

from node_support import NAME, Node, run_script, write
from ros_support import RosCore, wait_until


def test_the_panel_shows_what_the_camera_publishes(roscore: RosCore, tmp_path: Path) -> None:
    look = write(
        tmp_path / "look.py",
        """\
        def sysCall_init():
            self.camera, self.panel = sim.getObject('/ImagePublisher/Camera'), sim.getObject('/Panel')
            self.seen = set()

        def sysCall_sensing():
            self.seen.add(sim.getVisionSensorImg(self.camera)[0])
            if sim.getVisionSensorImg(self.panel)[0] in self.seen and len(self.seen) > 5:
                print('shown')
        """,
    )
    with Node(roscore.env, tmp_path / "log", "image_publisher", "--child-script", f"/Table={look}") as node:
        wait_until(lambda: NAME in roscore.nodes(), "the node")
        node.wait_for_output("shown")
        message = roscore.echo("/image", "--noarr")
        assert node.end() == 0
    for line in ("height: 192", "width: 256", 'encoding: "rgb8"', "step: 768", 'frame_id: "Camera_optical"'):
        assert line in message


def test_a_camera_shows_what_it_is_given_until_the_simulation_starts_again(tmp_path: Path) -> None:
    code = """\
        def sysCall_init():
            camera = sim.getObject('/Camera')
            before, (width, height) = sim.getVisionSensorImg(camera)
            picture = bytes(range(256)) * (width * height * 3 // 256)
            sim.setVisionSensorImg(camera, picture)
            assert sim.getVisionSensorImg(camera) == (picture, [width, height])
            sim.handleVisionSensor(camera)
            assert sim.getVisionSensorImg(camera)[0] == picture
            assert sim.getVisionSensorArray(camera)[-1, 0].tolist() == [0, 1, 2]  # from the bottom row up
            for wrong in camera, sim.getObject('/Lidar'):
                try:
                    sim.setVisionSensorImg(wrong, b'123')
                except (ValueError, LookupError) as error:
                    print(error)
        """
    run = run_script(tmp_path, code, "--strict", scene="sensors", target="/Mast")
    assert (run.stderr, run.returncode) == ("", 0)
    assert "640 x 480 pixels need 921600 bytes, found 3" in run.stdout
    assert "/Lidar is a lidar, not a camera" in run.stdout
