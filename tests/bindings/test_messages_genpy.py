# SPDX-License-Identifier: BSD-3-Clause
"""Every listed type, compared with genpy, which rospy uses."""

import contextlib
import hashlib
import io
from typing import Any

import genpy.message
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from message_support import ALL_TYPES, HALVES, codec, genpy_bytes, genpy_class, messages, same

quick = settings(
    max_examples=20, deadline=None, derandomize=True, database=None, suppress_health_check=list(HealthCheck)
)


@pytest.mark.parametrize("name", ALL_TYPES)
def test_md5_is_genpys(name: str) -> None:
    assert codec.type_hash(name) == genpy_class(name)._md5sum


@pytest.mark.parametrize("name", ALL_TYPES)
def test_definition_is_genpys(name: str) -> None:
    assert codec.definition(name) == genpy_class(name)._full_text


@pytest.mark.parametrize("name", ALL_TYPES)
def test_fields_are_genpys(name: str) -> None:
    names = {"byte": "int8", "char": "uint8"}
    expected = [
        (field, kind.replace(kind.split("[")[0], names.get(kind.split("[")[0], kind.split("[")[0])))
        for field, kind in zip(genpy_class(name).__slots__, genpy_class(name)._slot_types, strict=True)
    ]
    assert list(codec.fields(name).items()) == expected


@pytest.mark.parametrize("name", ALL_TYPES)
def test_constants_are_genpys(name: str) -> None:
    for constant, value in codec.constants(name).items():
        assert same(value, getattr(genpy_class(name), constant)), constant


@pytest.mark.parametrize("service", codec.service_names())
def test_service_md5_is_genpys(service: str) -> None:
    assert codec.service_type_hash(service) == genpy.message.get_service_class(service)._md5sum


def test_notification_md5_is_that_of_its_text() -> None:
    assert codec.type_hash("test_msgs/Notification") == hashlib.md5(b"string messages").hexdigest()


@pytest.mark.parametrize("name", ALL_TYPES)
def test_encoding_makes_genpys_bytes(name: str) -> None:
    @quick
    @given(messages(name))
    def check(message: dict[str, Any]) -> None:
        assert codec.encode(name, message) == genpy_bytes(name, message)

    check()


@pytest.mark.parametrize("name", ALL_TYPES)
def test_decoding_gives_what_genpy_wrote(name: str) -> None:
    @quick
    @given(messages(name))
    def check(message: dict[str, Any]) -> None:
        assert same(codec.decode(name, genpy_bytes(name, message)), message)

    check()


@pytest.mark.parametrize("name", ALL_TYPES)
def test_round_trips_are_exact(name: str) -> None:
    @quick
    @given(messages(name), st.sampled_from([codec.TimeForm.SECS_NSECS, codec.TimeForm.SEC_NANOSEC]))
    def check(message: dict[str, Any], form: object) -> None:
        data = genpy_bytes(name, message)
        assert codec.encode(name, codec.decode(name, data, form)) == data

    check()


@pytest.mark.parametrize("name", ALL_TYPES)
def test_missing_fields_have_genpys_defaults(name: str) -> None:
    buffer = io.BytesIO()
    genpy_class(name)().serialize(buffer)
    assert codec.encode(name, {}) == buffer.getvalue() == codec.encode(name, codec.default(name))


@pytest.mark.parametrize("name", ALL_TYPES)
def test_every_shortened_message_is_refused(name: str) -> None:
    @quick
    @given(messages(name), st.data())
    def check(message: dict[str, Any], data: st.DataObject) -> None:
        whole = genpy_bytes(name, message)
        if whole:
            cut = data.draw(st.integers(0, len(whole) - 1))
            with pytest.raises(codec.MessageError):
                codec.decode(name, whole[:cut])
        with pytest.raises(codec.MessageError):
            codec.decode(name, whole + b"\0")

    check()


@pytest.mark.parametrize("name", ALL_TYPES)
def test_random_bytes_never_crash_decoding(name: str) -> None:
    @quick
    @given(st.binary(max_size=200))
    def check(data: bytes) -> None:
        with contextlib.suppress(codec.MessageError):
            codec.decode(name, data)

    check()


def test_halves_of_all_services_are_tested() -> None:
    assert len(HALVES) == 2 * len(codec.service_names()) > 0
