# SPDX-License-Identifier: BSD-3-Clause
"""The messages of remote clients: what is decoded, what is refused."""

import contextlib

import cbor2
import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from bubblesim.remote import protocol

AT_LEISURE = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-(2**63), 2**64 - 1) | st.floats(allow_nan=False) | st.text() | st.binary(),
    lambda inner: st.lists(inner, max_size=5) | st.dictionaries(st.text(), inner, max_size=5),
    max_leaves=20,
)


def refusal(data: bytes) -> str:
    with pytest.raises(protocol.RequestError) as raised:
        protocol.decode(data)
    return str(raised.value)


@AT_LEISURE
@given(st.lists(VALUES, max_size=4))
def test_arguments_arrive_as_they_were(arguments: list[object]) -> None:
    request = protocol.decode(cbor2.dumps({"func": "sim.f", "args": arguments, "argsL": len(arguments), "uuid": "u"}))
    assert (request.function, request.arguments, request.uuid) == ("sim.f", arguments, "u")


@AT_LEISURE
@given(st.binary(max_size=300))
@example(b"\x9b" + b"\xff" * 8)  # a list of 2**64 - 1 items
@example(b"\x5b" + b"\x7f" + b"\xff" * 7)  # 2**63 bytes
@example(b"\xbb" + b"\xff" * 8)
@example(b"\x81" * 300)
@example(b"\x9f" * 300)
@example(b"\xbf\x01\xff")
@example(b"\xc4\x82\x1b" + b"\xff" * 8 + b"\x01")  # a decimal fraction with a huge exponent
@example(b"\xd8\x23\x61(")  # a regular expression
@example(b"\x7f\x61a\xff")
@example(b"\x1c")
@example(b"")
def test_any_bytes_are_decoded_or_refused(data: bytes) -> None:
    with contextlib.suppress(protocol.RequestError):
        assert protocol.decode(data).function == cbor2.loads(data)["func"]


@AT_LEISURE
@given(VALUES, st.integers(0, 400), st.integers(0, 255))
def test_a_changed_message_is_decoded_or_refused(value: object, place: int, byte: int) -> None:
    data = bytearray(cbor2.dumps({"func": "sim.f", "args": [value], "uuid": "u"}))
    data[place % len(data)] = byte
    with contextlib.suppress(protocol.RequestError):
        protocol.decode(bytes(data))


@pytest.mark.parametrize(
    ("message", "reason"),
    [
        ([1], "not a map with the string 'func'"),
        ({"args": []}, "not a map with the string 'func'"),
        ({"func": 1}, "not a map with the string 'func'"),
        ({"func": "f", "args": "text"}, "'args' is not a list but of type str"),
        ({"func": "f", "uuid": 5}, "'uuid' is not a string"),
        ({"func": "f", "args": [cbor2.CBORTag(1, 5)]}, "tagged values are not supported"),
    ],
)
def test_a_refusal_states_why(message: object, reason: str) -> None:
    assert reason in refusal(cbor2.dumps(message))


def test_a_large_message_is_refused_or_decoded_quickly() -> None:
    assert "at most" in refusal(bytes(protocol.MOST_BYTES + 1))
    assert "200,000 values" in refusal(b"\x9a\x00\x50\x00\x00" + b"\x00" * 0x500000)
    big = protocol.decode(cbor2.dumps({"func": "f", "args": [bytes(60_000_000)], "uuid": "u"}))
    assert len(big.arguments[0]) == 60_000_000


def test_replies_hold_texts_bytes_and_arrays_as_bytes() -> None:
    image = np.arange(6, dtype=np.uint8).reshape(2, 3)
    reply = cbor2.loads(protocol.result(("text", b"\x00\xff", image[:, ::2], np.float64(0.5), None, [np.int32(3)])))
    assert reply == {"ret": ["text", b"\x00\xff", bytes([0, 2, 3, 5]), 0.5, None, [3]]}
    assert cbor2.loads(protocol.result(None)) == {"ret": []}
    with pytest.raises(TypeError, match="a value of type object"):
        protocol.result(object())
