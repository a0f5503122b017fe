# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's velocity control of multicopters, on the model of the scene quadcopter."""

from pathlib import Path

import pytest

import bubblesim
from bubblesim.gazebo_plugins.robots import GazeboPlugins
from node_support import Node, write
from ros_peer import Peer
from ros_support import REPOSITORY, RosCore

ROTORS = "".join(f"<rotor><jointName>rotor_{i}_joint</jointName></rotor>" for i in range(4))
GAINS = """<velocityGain>2.7 2.7 2.7</velocityGain><attitudeGain>2 2 0.15</attitudeGain>
<angularRateGain>0.4 0.4 0.18</angularRateGain>"""


def scene(folder: Path, parameters: str) -> Path:
    model = (REPOSITORY / "scenes" / "models" / "quadcopter" / "model.sdf").read_text()
    control = f'<plugin name="it" filename="gz-sim-multicopter-control-system">{parameters}</plugin>'
    start = model.index("<model")
    robot = model[start:].replace("</model>", f"{control}</model>").replace("</sdf>", "")
    floor = "<include><uri>model://floor</uri></include>"
    return write(
        folder / "control.sdf",
        f'<sdf version="1.9" xmlns:bubblesim="https://bubblesim"><world name="w">{floor}{robot}</world></sdf>',
    )


def test_it_flies_at_the_velocity_of_a_twist_until_it_is_disabled(roscore: RosCore, tmp_path: Path) -> None:
    parameters = f"""<robotNamespace>X3</robotNamespace><comLinkName>base_link</comLinkName>{GAINS}
      <rotorConfiguration>{ROTORS}</rotorConfiguration><maximumLinearVelocity>2 2 0.5</maximumLinearVelocity>"""
    altimeter = "/altimeter", "geometry_msgs/PointStamped"
    roscore.set_param("/use_sim_time", True)
    with Node(roscore.env, tmp_path / "log", scene(tmp_path, parameters)), Peer(roscore, tmp_path / "received") as peer:
        peer.next(*altimeter)
        peer.publish("/X3/cmd_vel", "geometry_msgs/Twist", {"linear": {"z": 9.0}, "angular": {}})
        low = peer.wait_for(*altimeter, lambda it: it["point"]["z"] > 1.0, "the climb")
        high = peer.wait_for(*altimeter, lambda it: it["point"]["z"] > low["point"]["z"] + 1.0, "the climb")
        speed = (high["point"]["z"] - low["point"]["z"]) / (high["header"]["stamp"] - low["header"]["stamp"])
        assert speed == pytest.approx(0.5, abs=0.1), "limited, with the noise of the altimeter"
        peer.publish("/X3/enable", "std_msgs/Bool", {"data": False})
        peer.wait_for(*altimeter, lambda it: it["point"]["z"] < 0.3, "the fall")


@pytest.mark.parametrize(
    ("parameters", "text"),
    [
        ("<comLinkName>base</comLinkName>", "<comLinkName> is 'base', which is not a link of /Quadcopter"),
        (
            f"<comLinkName>base_link</comLinkName><rotorConfiguration>{ROTORS}</rotorConfiguration>",
            "<velocityGain> is missing, it must be 3 numbers",
        ),
        (
            "<comLinkName>base_link</comLinkName><rotorConfiguration><rotor><jointName>r</jointName></rotor>"
            f"</rotorConfiguration>{GAINS}",
            "<rotorConfiguration> is 'r', which is not a joint of /Quadcopter",
        ),
    ],
)
def test_bad_parameters_are_reported(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], parameters: str, text: str
) -> None:
    GazeboPlugins(bubblesim.Simulation(str(scene(tmp_path, parameters))), None)
    assert text in capfd.readouterr().err
