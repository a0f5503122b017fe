# SPDX-License-Identifier: BSD-3-Clause
"""The transforms of a step are in one message, all of them or none."""

from bubblesim._core.reading_messages import Clock, Header

from bubblesim.gazebo_plugins.transforms import Transforms

POSE = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]


class Bridge:
    """A bridge whose topic gets a subscriber when it has been asked once."""

    def __init__(self) -> None:
        self.asked = self.published = 0

    def advertise(self, *_: object) -> int:
        return 1

    def wants_messages(self, _publisher: int) -> bool:
        self.asked += 1
        return self.asked > 1

    def publish(self, *_: object) -> None:
        self.published += 1


def test_a_subscriber_that_comes_within_a_step_gets_no_part_of_it() -> None:
    bridge = Bridge()
    transforms = Transforms(bridge)
    published = []
    for _ in range(2):
        for frame in ("base_link", "left_wheel"):
            transforms.add(Header(Clock(), "odom"), frame, POSE)
        transforms.publish()
        published.append(bridge.published)
    assert published == [0, 1]
