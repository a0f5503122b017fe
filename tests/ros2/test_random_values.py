# SPDX-License-Identifier: BSD-3-Clause
"""Random values of all types, compared with rclpy field by field."""

import math
import re
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bubblesim import _core
from ros2_peer import PEERS, Ros2Peer, has_ros2

codec = _core.messages
ROS2 = codec.RosVersion.ROS2
HEADER = b"\0\1\0\0"  # little endian CDR

pytestmark = has_ros2
few = settings(max_examples=3, deadline=None, derandomize=True, database=None, suppress_health_check=list(HealthCheck))


def common_types() -> list[str]:
    """Return the types of this build that rclpy's packages have, too."""
    theirs = {f"{file.parents[1].name}/{file.stem}" for file in PEERS.glob("share/*/msg/*.msg")}
    return sorted(theirs & set(codec.message_names(ROS2)))


@cache
def values(spelling: str) -> st.SearchStrategy[Any]:
    """Return values of a field type such as "float64[36]"; limits and special numbers are likely."""
    if array := re.fullmatch(r"(.+)\[(<=)?(\d*)\]", spelling):
        base, is_bounded, length = array.groups()
        least, most = int(length or 0) if not is_bounded else 0, int(length or 3)
        return st.lists(values(base), min_size=least, max_size=most)
    if integer := re.fullmatch(r"(u?)int(\d+)", spelling):
        bits = int(integer[2])
        return st.integers(0, 2**bits - 1) if integer[1] else st.integers(-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    if spelling in ("time", "duration"):
        return st.fixed_dictionaries({"sec": values("int32"), "nanosec": st.integers(0, 999_999_999)})
    simple: dict[str, st.SearchStrategy[Any]] = {
        "bool": st.booleans(),
        "string": st.text(st.characters(blacklist_characters="\0", blacklist_categories=["Cs"]), max_size=6),
        "float32": st.floats(width=32),
        "float64": st.floats(),
    }
    return simple[spelling] if spelling in simple else messages(spelling)


@cache
def messages(name: str) -> st.SearchStrategy[dict[str, Any]]:
    """Return dicts of a message type with all its fields."""
    return st.fixed_dictionaries({field: values(kind) for field, kind in codec.fields(name, ROS2).items()})


def plain(value: Any) -> Any:
    """Return a value that equals itself: without numpy, bytes as lists of numbers, NaN as text."""
    if isinstance(value, dict):
        return {name: plain(item) for name, item in value.items()}
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, bytes | list):
        return [plain(item) for item in value]
    return "nan" if isinstance(value, float) and math.isnan(value) else value


def test_most_types_are_compared() -> None:
    assert len(common_types()) > 100


@pytest.mark.parametrize("package", sorted({name.split("/")[0] for name in common_types()}))
def test_ros2_reads_what_is_written_here_and_the_reverse(ros2_peer: Ros2Peer, package: str) -> None:
    for name in common_types():
        if name.startswith(f"{package}/"):
            compare(ros2_peer, name)


def compare(peer: Ros2Peer, name: str) -> None:
    @few
    @given(messages(name))
    def check(message: dict[str, Any]) -> None:
        ours = HEADER + codec.encode_ros2(name, message)
        read, theirs = peer.recode(name.replace("/", "/msg/"), ours)
        assert plain(read) == plain(message), name
        assert theirs[:4] == HEADER, name
        assert plain(codec.decode_ros2(name, theirs[4:], codec.TimeForm.SEC_NANOSEC)) == plain(message), name

    check()
