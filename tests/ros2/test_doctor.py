# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim doctor checks what ROS 2 depends on."""

import pytest

from cli_support import bubblesim
from ros2_peer import Domain


def test_domain_and_range_are_named(ros2_domain: Domain) -> None:
    run = bubblesim("doctor", "ros", ROS_DOMAIN_ID=str(ros2_domain.number))
    assert f"nodes of ROS 2 are looked for in domain {ros2_domain.number} on this machine" in run.stdout
    assert "UDP packets arrive on this machine" in run.stdout
    wide = bubblesim(
        "doctor",
        "ros",
        ROS_DOMAIN_ID=str(ros2_domain.number),
        ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET",
        ROS_STATIC_PEERS="robot;10.0.0.2",
    )
    assert f"in domain {ros2_domain.number} on the local network and robot, 10.0.0.2" in wide.stdout


@pytest.mark.parametrize(
    ("env", "reported", "cure"),
    [
        ({"ROS_DOMAIN_ID": "500"}, "ROS_DOMAIN_ID=500 is not a domain, 0 to 232", "export ROS_DOMAIN_ID=0"),
        (
            {"ROS_AUTOMATIC_DISCOVERY_RANGE": "HOUSE"},
            "ROS_AUTOMATIC_DISCOVERY_RANGE=HOUSE must be one of LOCALHOST, SUBNET, SYSTEM_DEFAULT, OFF",
            "unset ROS_AUTOMATIC_DISCOVERY_RANGE",
        ),
    ],
)
@pytest.mark.usefixtures("ros2_domain")
def test_values_that_are_none_are_problems(env: dict[str, str], reported: str, cure: str) -> None:
    run = bubblesim("doctor", "ros", **env)
    assert run.returncode == 1
    assert f"problem  {reported}" in run.stdout
    assert cure in run.stdout
