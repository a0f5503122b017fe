# SPDX-License-Identifier: BSD-3-Clause
"""Messages of one stamp show one state: that of a mover, 10 m/s fast, at this time."""

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from node_support import NAME, Node, write
from ros_peer import Message, Peer
from ros_support import RosCore, wait_until

SPEED = 10.0  # m/s
WALL = 8.0  # m, x of its face
EXACT = 1e-6  # m and rad
STEP = 0.05  # s
STEPS = 12

# Sends the pose of the mover, and what its sonar measures on request, in all phases of a step.
SCRIPT = """\
#python
from bubblesim import ros_messages

def sysCall_init():
    self.body = sim.getObject('.')
    self.sonar = sim.getObject('./sonar')
    simROS.subscribe('/poke', 'std_msgs/Empty', lambda _: send('callback'))

def send(phase):
    seen, distance, *_ = sim.handleProximitySensor(self.sonar)
    stamp = simROS.getTime()
    assert abs(simROS2.timeToFloat(simROS2.getSimulationTime()) - stamp) < 1e-6
    assert abs(sim.getReadingTime(self.sonar) - stamp) < 1e-6
    simROS.sendTransform(ros_messages.transform(stamp, 'world', phase, sim.getObjectPose(self.body)))
    ahead = [distance, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    simROS.sendTransform(ros_messages.transform(stamp, phase, f'{phase} ahead', ahead))

def sysCall_actuation():
    send('actuation')

def sysCall_sensing():
    send('sensing')
"""
TOPICS = {
    "/clock": "rosgraph_msgs/Clock",
    "/tf": "tf2_msgs/TFMessage",
    "/scan": "sensor_msgs/LaserScan",
    "/laser": "sensor_msgs/LaserScan",
    "/depth": "sensor_msgs/Image",
    "/imu": "sensor_msgs/Imu",
    "/truth": "nav_msgs/Odometry",
    "/odom": "nav_msgs/Odometry",
    "/plate": "nav_msgs/Odometry",
    "/joint_states": "sensor_msgs/JointState",
}


@pytest.fixture(scope="module")
def core(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RosCore]:
    with RosCore(tmp_path_factory.mktemp("core")) as core:
        core.set_param("/use_sim_time", True)
        yield core


class Drive:
    """What was received of a drive; `at` is the time at which it began at the origin."""

    def __init__(self, peer: Peer, turning: float) -> None:
        def connected() -> bool:  # until then the mover stands; the periods of all rates are even numbers of steps
            assert peer.call(f"{NAME}/step", steps=2)["success"]
            return all(peer.received(*topic) for topic in TOPICS.items())

        wait_until(connected, "all topics")
        twist = {"linear": {"x": SPEED}, "angular": {"z": turning}}
        pose = {"orientation": {"w": 1.0}}
        state = {"model_name": "mover", "pose": pose, "twist": twist}
        assert peer.call("/gazebo/set_model_state", model_state=state)["success"]
        self.at = peer.call(f"{NAME}/step", steps=0)["time"]
        self.turning = turning
        before = {topic: len(peer.received(topic)) for topic in TOPICS}
        for _ in range(STEPS):
            poked = len(self._frames(peer.received("/tf"), "callback ahead"))
            peer.publish("/poke", "std_msgs/Empty", {})
            wait_until(lambda n=poked: len(self._frames(peer.received("/tf"), "callback ahead")) > n, "the callback")
            assert peer.call(f"{NAME}/step", steps=1)["success"]
        end = self.at + STEPS * STEP - STEP / 2
        wait_until(lambda: all(_stamp(peer.received(topic)[-1]) > end for topic in TOPICS), "the last messages")
        self.messages: dict[str, list[Message]] = {
            topic: [each for each in peer.received(topic)[before[topic] :] if _stamp(each) > self.at + STEP / 2]
            for topic in TOPICS
        }

    @staticmethod
    def _frames(messages: list[Message], frame: str) -> list[Message]:
        transforms = [transform for message in messages for transform in message["transforms"]]
        return [transform for transform in transforms if transform["child_frame_id"] == frame]

    def frames(self, frame: str) -> list[Message]:
        return self._frames(self.messages["/tf"], frame)

    def steps_of(self, messages: list[Message]) -> list[int]:
        """Return the numbers of steps since the start, by the stamps."""
        return [round((_stamp(message) - self.at) / STEP) for message in messages]

    def x(self, message: Message) -> float:
        return SPEED * (_stamp(message) - self.at)

    def heading(self, message: Message) -> float:
        return self.turning * (_stamp(message) - self.at)

    def ahead(self, message: Message) -> float:
        """Return the distance to the wall along the heading."""
        return (WALL - self.x(message)) / math.cos(self.heading(message))


def _stamp(message: Message) -> float:
    if "clock" in message:
        return float(message["clock"])
    stamped = message["transforms"][0] if "transforms" in message else message
    return float(stamped["header"]["stamp"])


@pytest.fixture(scope="module", params=[0.0, 1.0], ids=["straight", "turning"])
def drive(request: pytest.FixtureRequest, core: RosCore, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Drive]:
    folder = tmp_path_factory.mktemp("run")
    script = write(folder / "fast.py", SCRIPT)
    scene = Path(__file__).with_name("fast.sdf")
    options = ["--paused", "--gazebo-compat", "--strict", "--child-script", f"/mover={script}"]
    with Node(core.env, folder / "log", scene, *options), Peer(core, folder / "received") as peer:
        yield Drive(peer, request.param)


def _check_pose(drive: Drive, message: Message, position: Message, rotation: Message) -> None:
    assert position["x"] == pytest.approx(drive.x(message), abs=EXACT)
    assert 2 * math.atan2(rotation["z"], rotation["w"]) == pytest.approx(drive.heading(message), abs=EXACT)


@pytest.mark.parametrize("topic", ["/truth", "/odom"])
def test_odometry_and_ground_truth_show_the_pose_at_their_stamp(drive: Drive, topic: str) -> None:
    messages = drive.messages[topic]
    assert drive.steps_of(messages) == list(range(1, STEPS + 1))
    for message in messages:
        _check_pose(drive, message, message["pose"]["pose"]["position"], message["pose"]["pose"]["orientation"])


@pytest.mark.parametrize("frame", ["body", "callback", "actuation", "sensing"])
def test_transforms_show_the_pose_at_their_stamp(drive: Drive, frame: str) -> None:
    transforms = drive.frames(frame)
    assert set(drive.steps_of(transforms)) >= set(range(1, STEPS))
    for each in transforms:
        _check_pose(drive, each, each["transform"]["translation"], each["transform"]["rotation"])


@pytest.mark.parametrize("phase", ["callback", "actuation", "sensing"])
def test_what_a_script_measures_agrees_with_the_pose_that_it_sends(drive: Drive, phase: str) -> None:
    measured = drive.frames(f"{phase} ahead")
    assert len(measured) >= STEPS - 1
    for each in measured:
        assert each["transform"]["translation"]["x"] == pytest.approx(drive.ahead(each), abs=EXACT)


@pytest.mark.parametrize(("topic", "every"), [("/scan", 2), ("/laser", 1)])
def test_scans_show_the_distance_at_their_stamp(drive: Drive, topic: str, every: int) -> None:
    scans = drive.messages[topic]
    assert len(scans) == STEPS // every
    assert {step % every for step in drive.steps_of(scans)} == {0}
    for scan in scans:
        assert scan["ranges"] == pytest.approx([drive.ahead(scan)], abs=EXACT)


def test_images_show_the_distance_at_their_stamp(drive: Drive) -> None:
    images = drive.messages["/depth"]
    assert len(images) == STEPS // 2
    for image in images:
        middle = np.frombuffer(image["data"], "<f4")[4]
        assert middle == pytest.approx(drive.ahead(image), abs=EXACT)


def test_an_imu_shows_the_heading_at_its_stamp(drive: Drive) -> None:
    for imu in drive.messages["/imu"]:
        rotation = imu["orientation"]
        assert 2 * math.atan2(rotation["z"], rotation["w"]) == pytest.approx(drive.heading(imu), abs=EXACT)


def test_joint_states_show_the_position_at_their_stamp(drive: Drive) -> None:
    plates = {_stamp(message): message["pose"]["pose"]["position"]["y"] for message in drive.messages["/plate"]}
    joints = {_stamp(message): message["position"][0] for message in drive.messages["/joint_states"]}
    assert joints.keys() == plates.keys()
    for stamp, position in joints.items():
        assert position == pytest.approx(plates[stamp], abs=EXACT)
        assert position == pytest.approx(SPEED * stamp, abs=EXACT), "the motor runs from time 0 on"


def test_the_clock_shows_the_end_of_each_step_and_all_stamps(drive: Drive) -> None:
    times = drive.steps_of(drive.messages["/clock"])
    assert sorted(set(times)) == list(range(1, STEPS + 1))
    for topic in TOPICS:
        assert set(drive.steps_of(drive.messages[topic])) <= set(times), topic


def test_a_lidar_of_10_hz_measures_at_multiples_of_its_period(drive: Drive) -> None:
    for scan in drive.messages["/scan"]:
        periods = _stamp(scan) / 0.1
        assert periods == pytest.approx(round(periods), abs=1e-6)
