# SPDX-License-Identifier: BSD-3-Clause
"""Bytes of any content are decoded or refused: messages of both versions of ROS, changed at random.

The default number of messages suits each run of the tests; with AddressSanitizer, see CONTRIBUTING.md, more of them:
``BUBBLESIM_FUZZ_MESSAGES=1000000``.
"""

import itertools
import os
import random

import pytest

from bubblesim import _core

codec = _core.messages
ROS1, ROS2 = codec.RosVersion.ROS1, codec.RosVersion.ROS2
COUNT = int(os.environ.get("BUBBLESIM_FUZZ_MESSAGES", "40000"))  # of each version

# Lengths and counts at which arithmetic goes wrong.
NUMBERS = [0, 1, 2, 3, 7, 8, 255, 2**16, 2**24, 2**31 - 1, 2**31, 2**32 - 8, 2**32 - 4, 2**32 - 1]


def grown(message: object, chance: random.Random) -> object:
    """Return a message with elements in its empty arrays and strings, so that there is something to change."""
    if isinstance(message, dict):
        return {name: grown(value, chance) for name, value in message.items()}
    if isinstance(message, str):
        return "x" * chance.randrange(6)
    if isinstance(message, bytes):
        return chance.randbytes(len(message) or chance.randrange(9))
    return message


def changed(data: bytes, chance: random.Random) -> bytes:
    """Return bytes with some changes: single bytes, a length in a place for one, a part cut, repeated or random."""
    result = bytearray(data)
    for _ in range(chance.randrange(1, 5)):
        at = chance.randrange(len(result) + 1)
        kind = chance.randrange(5)
        if kind == 0:
            result[at : at + 1] = chance.randbytes(1)
        elif kind == 1:
            result[at // 4 * 4 : at // 4 * 4 + 4] = chance.choice(NUMBERS).to_bytes(4, "little")
        elif kind == 2:
            del result[at:]
        elif kind == 3:
            result[at:at] = result[at : at + chance.randrange(16)]
        else:
            result[at:at] = chance.randbytes(chance.randrange(32))
    return bytes(result)


@pytest.mark.parametrize("version", [ROS1, ROS2])
def test_changed_bytes_are_decoded_or_refused(version: _core.messages.RosVersion) -> None:
    encode, decode = (codec.encode, codec.decode) if version == ROS1 else (codec.encode_ros2, codec.decode_ros2)
    names = codec.message_names(version)
    if not names:
        pytest.skip("built without ROS 2")
    chance = random.Random(11)
    decoded = refused = 0
    for name in itertools.islice(itertools.cycle(names), COUNT):
        message = grown(codec.default(name, version=version), chance)
        data = changed(encode(name, message), chance)
        try:
            found = decode(name, data)
        except codec.MessageError:
            refused += 1
            continue
        decoded += 1
        encode(name, found)  # what was decoded is a message
    assert decoded > COUNT // 20
    assert refused > COUNT // 20
