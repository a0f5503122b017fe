# SPDX-License-Identifier: BSD-3-Clause
"""Calls of a master, and of what is none."""

import socket
from collections.abc import Iterator

import pytest

from bubblesim.program.ros_calls import FailedRosCallError, RosCallError, call
from ros_support import RosCore, free_port

CALLER = "/test"


@pytest.fixture
def silent() -> Iterator[str]:
    """Yield the address of a server that accepts connections and never answers."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield f"http://127.0.0.1:{server.getsockname()[1]}"


def test_a_call_returns_the_value(roscore: RosCore) -> None:
    uri = roscore.env["ROS_MASTER_URI"]
    assert call(uri, CALLER, "getUri").rstrip("/").endswith(f":{roscore.port}")


def test_a_failed_call_differs_from_one_without_an_answer(roscore: RosCore) -> None:
    with pytest.raises(FailedRosCallError, match=r"getParam failed: .*/missing"):
        call(roscore.env["ROS_MASTER_URI"], CALLER, "getParam", "/missing")
    with pytest.raises(RosCallError, match=r"does not answer getParam: .*refused") as error:
        call(f"http://127.0.0.1:{free_port()}", CALLER, "getParam", "/missing")
    assert not isinstance(error.value, FailedRosCallError)


def test_a_server_that_is_silent_does_not_hold_up_the_caller(silent: str) -> None:
    with pytest.raises(RosCallError) as error:
        call(silent, CALLER, "getPid")
    assert isinstance(error.value.__cause__, TimeoutError)
