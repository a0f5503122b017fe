# SPDX-License-Identifier: BSD-3-Clause
"""The Python values that a field accepts, and the values that decoding returns."""

import array
import math
from collections import OrderedDict
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from message_support import codec, genpy_bytes, same


def back(name: str, value: Any) -> Any:
    """Return a value of field `data` after a round trip."""
    return codec.decode(name, codec.encode(name, {"data": value}))["data"]


@pytest.mark.parametrize(
    "value", [2, 2.0, np.float32(2), np.float64(2), np.int8(2), np.uint64(2), Fraction(2), True + 1]
)
def test_floats_take_all_real_numbers(value: Any) -> None:
    assert same(back("std_msgs/Float64", value), 2.0)


@pytest.mark.parametrize("value", [2, 2.0, np.float64(2), np.int8(2), np.uint64(2)])
@pytest.mark.parametrize("name", ["Int8", "UInt16", "Int64", "UInt64"])
def test_integers_take_all_whole_numbers(name: str, value: Any) -> None:
    assert same(back(f"std_msgs/{name}", value), 2)


@pytest.mark.parametrize("make", [float, np.float64, np.float32, np.float16])
@pytest.mark.parametrize(
    ("name", "value", "result"),
    [("Int32", 1.75, 1), ("Int32", -1.75, -1), ("UInt8", 255.5, 255), ("UInt8", -0.5, 0), ("Int64", -0.5, 0)],
)
def test_integers_take_floats_truncated_toward_zero(name: str, value: float, result: int, make: Any) -> None:
    assert back(f"std_msgs/{name}", make(value)) == result


@pytest.mark.parametrize("make", [list, np.array, lambda values: np.array(values, dtype=object)])
def test_arrays_of_integers_take_floats_truncated_toward_zero(make: Any) -> None:
    assert list(back("std_msgs/Int16MultiArray", make([1.75, -1.75, 3.0]))) == [1, -1, 3]


def test_nanoseconds_that_are_not_quite_whole_are_truncated() -> None:
    t = 0.15
    nanoseconds = (t - math.floor(t)) * 10**9  # 150000000.00000003 for some times
    assert back("std_msgs/Time", {"secs": 0, "nsecs": 150000000.00000003}) == {"secs": 0, "nsecs": 150_000_000}
    assert back("std_msgs/Time", {"secs": math.floor(t), "nsecs": nanoseconds})["nsecs"] == int(nanoseconds)


@pytest.mark.parametrize("value", [150000000.00000003, 7.0009, -7.0009, 3])
def test_nothing_is_reported_of_less_than_a_thousandth(value: float) -> None:
    assert codec.truncations("std_msgs/Int32", {"data": value}) is None


@pytest.mark.parametrize(
    ("name", "message", "truncations"),
    [
        ("std_msgs/UInt8", {"data": 7.0011}, [("data", 7.0011)]),
        ("std_msgs/UInt8", {"data": np.float32(-0.5)}, [("data", -0.5)]),
        ("rosgraph_msgs/Clock", {"clock": {"secs": 1.5, "nsecs": 2.25}}, [("clock.secs", 1.5), ("clock.nsecs", 2.25)]),
        ("std_msgs/Int8MultiArray", {"data": [1, 1.5, 2.5]}, [("data", 1.5)]),
        ("std_msgs/Int8MultiArray", {"data": np.array([1, 1.5, 2.5])}, [("data", 1.5)]),
        (
            "std_msgs/Int8MultiArray",
            {"layout": {"dim": [{"size": 1.5}, {"size": 2.5, "stride": 3.5}], "data_offset": 4.5}, "data": [5.5]},
            [("layout.dim.size", 1.5), ("layout.dim.stride", 3.5), ("layout.data_offset", 4.5), ("data", 5.5)],
        ),
        ("std_msgs/Float64", {"data": 1.5}, None),
        ("std_msgs/Time", {"data": 1.5}, None),
    ],
)
def test_each_truncated_field_is_named_once_with_its_first_value(name: str, message: Any, truncations: Any) -> None:
    assert codec.truncations(name, message) == truncations


@pytest.mark.parametrize(
    ("value", "result"), [(True, True), (0, False), (1, True), (np.bool_(True), True), (1.0, True)]
)
def test_bools_take_0_and_1(value: Any, result: bool) -> None:
    assert back("std_msgs/Bool", value) is result


@pytest.mark.parametrize("value", [True, np.bool_(True)])
@pytest.mark.parametrize("name", ["Int32", "UInt64", "Float32"])
@pytest.mark.filterwarnings("error")  # numpy 2 warns of its bools as indices
def test_numbers_take_bools(name: str, value: Any) -> None:
    assert back(f"std_msgs/{name}", value) == 1


@pytest.mark.parametrize("value", [-(2**63), 2**63 - 1, 2**53 + 1])
def test_64_bit_integers_are_exact(value: int) -> None:
    assert back("std_msgs/Int64", value) == value


def test_unsigned_64_bit_integers_are_exact() -> None:
    assert back("std_msgs/UInt64", 2**64 - 1) == 2**64 - 1


@pytest.mark.parametrize("value", ["", "grün €", "a\0b", np.str_("numpy")])
def test_texts_come_back(value: str) -> None:
    assert back("std_msgs/String", value) == value


def test_strings_take_bytes() -> None:
    assert back("std_msgs/String", b"abc") == "abc"


def test_bytes_that_are_no_utf_8_come_back() -> None:
    text = back("std_msgs/String", b"a\xff\xfeb")
    assert codec.encode("std_msgs/String", {"data": text}) == b"\4\0\0\0a\xff\xfeb"


@pytest.mark.parametrize(
    "value", [1.5, {"secs": 1, "nsecs": 500_000_000}, {"sec": 1, "nanosec": 500_000_000}, np.float32(1.5)]
)
@pytest.mark.parametrize("name", ["std_msgs/Time", "std_msgs/Duration"])
def test_times_take_seconds_and_both_dicts(name: str, value: Any) -> None:
    assert back(name, value) == {"secs": 1, "nsecs": 500_000_000}


def test_negative_durations_have_positive_nanoseconds() -> None:
    assert back("std_msgs/Duration", -0.25) == {"secs": -1, "nsecs": 750_000_000}


def test_seconds_are_rounded_to_nanoseconds() -> None:
    assert back("std_msgs/Time", 1.9999999999) == {"secs": 2, "nsecs": 0}


def test_parts_of_times_may_be_missing() -> None:
    assert back("std_msgs/Time", {"sec": 3}) == {"secs": 3, "nsecs": 0}


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (codec.TimeForm.SECS_NSECS, {"secs": 1, "nsecs": 250_000_000}),
        (codec.TimeForm.SEC_NANOSEC, {"sec": 1, "nanosec": 250_000_000}),
        (codec.TimeForm.FLOAT, 1.25),
    ],
)
def test_times_come_in_the_chosen_form(form: Any, value: Any) -> None:
    data = codec.encode("std_msgs/Time", {"data": 1.25})
    assert codec.decode("std_msgs/Time", data, form) == {"data": value}
    assert same(codec.default("std_msgs/Time", form), codec.decode("std_msgs/Time", bytes(8), form))


FLOATS = [0.5, -1.0, float("inf")]


@pytest.mark.parametrize(
    "values",
    [
        FLOATS,
        tuple(FLOATS),
        np.array(FLOATS, dtype=np.float32),
        np.array(FLOATS),
        np.array(FLOATS, dtype=np.float16),
        np.array(FLOATS, dtype=">f4"),
        np.array(FLOATS, dtype=object),
        np.repeat(np.array(FLOATS, dtype=np.float32), 2)[::2],
        np.array([FLOATS], dtype=np.float32).T,
        array.array("f", FLOATS),
        array.array("d", FLOATS),
        memoryview(array.array("f", FLOATS)),
        [np.float32(value) for value in FLOATS],
    ],
)
def test_arrays_of_floats_take_sequences_and_buffers(values: Any) -> None:
    assert codec.encode("std_msgs/Float32MultiArray", {"data": values}) == genpy_bytes(
        "std_msgs/Float32MultiArray", {"layout": {"dim": [], "data_offset": 0}, "data": FLOATS}
    )


def test_arrays_of_floats_come_back_as_their_own_numpy_arrays() -> None:
    values = back("std_msgs/Float32MultiArray", FLOATS)
    assert values.dtype == np.float32
    assert values.flags.owndata
    assert values.flags.writeable


@pytest.mark.parametrize("dtype", [np.int8, np.uint8, np.int16, np.int64, np.uint64, np.float64, np.bool_, ">i4"])
@pytest.mark.parametrize("name", ["Int8", "UInt8", "Int16", "UInt32", "Int64", "UInt64", "Float32", "Float64"])
def test_arrays_of_other_dtypes_are_converted_when_all_fits(name: str, dtype: Any) -> None:
    values = np.array([0, 1, 1], dtype=dtype)
    assert list(back(f"std_msgs/{name}MultiArray", values)) == [0, 1, 1]


def test_lists_that_are_ranges_are_taken() -> None:
    assert list(back("std_msgs/Int32MultiArray", range(3))) == [0, 1, 2]


@pytest.mark.parametrize(
    "value",
    [
        b"\1\2\xff",
        bytearray(b"\1\2\xff"),
        memoryview(b"\1\2\xff"),
        np.array([1, 2, 255], dtype=np.uint8),
        "\1\2\xff",
        [1, 2, 255],
        memoryview(b"\1_\2_\xff_")[::2],
    ],
)
def test_uint8_arrays_take_all_that_holds_bytes(value: Any) -> None:
    assert back("std_msgs/UInt8MultiArray", value) == b"\1\2\xff"


def test_images_may_have_their_shape() -> None:
    pixels = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)
    message = codec.decode("sensor_msgs/Image", codec.encode("sensor_msgs/Image", {"data": pixels}))
    assert message["data"] == pixels.tobytes()


def test_arrays_of_strings_take_numpy_arrays() -> None:
    data = codec.encode("sensor_msgs/JointState", {"name": np.array(["a", "bc"])})
    assert codec.decode("sensor_msgs/JointState", data)["name"] == ["a", "bc"]


def test_messages_of_numbers_take_the_rows_of_a_numpy_array() -> None:
    rows = np.arange(6.0).reshape(2, 3)
    points = [{"x": 0.0, "y": 1.0, "z": 2.0}, {"x": 3.0, "y": 4.0, "z": 5.0}]
    for values in (rows, rows.astype(np.float32), rows[::-1][::-1], rows.astype(int)):
        encoded = codec.encode("sensor_msgs/PointCloud", {"points": values})
        assert encoded == codec.encode("sensor_msgs/PointCloud", {"points": points})
    assert codec.encode("sensor_msgs/PointCloud", {"points": rows[:0]}) == codec.encode("sensor_msgs/PointCloud", {})
    with pytest.raises(ValueError, match="points"):
        codec.encode("sensor_msgs/PointCloud", {"points": rows[:, :2]})


def test_empty_arrays_come_back() -> None:
    assert len(back("std_msgs/Float64MultiArray", [])) == 0
    assert len(back("std_msgs/Float64MultiArray", np.array([]))) == 0
    assert back("std_msgs/UInt8MultiArray", b"") == b""


def test_subclasses_of_dict_are_dicts() -> None:
    assert codec.encode("std_msgs/Int8", OrderedDict(data=5)) == b"\5"


def test_fields_may_come_in_any_order() -> None:
    one = {"linear": {"x": 1, "y": 2, "z": 3}, "angular": {"z": 6}}
    other = {"angular": {"z": 6}, "linear": {"z": 3, "x": 1, "y": 2}}
    assert codec.encode("geometry_msgs/Twist", one) == codec.encode("geometry_msgs/Twist", other)


def test_field_names_need_not_be_interned() -> None:
    assert codec.encode("std_msgs/Int8", {"".join(["da", "ta"]): 5}) == b"\5"


def test_both_spellings_of_a_type_are_the_same() -> None:
    assert codec.encode("std_msgs/msg/Int8", {"data": 1}) == codec.encode("std_msgs/Int8", {"data": 1})


@pytest.mark.parametrize("wrap", [bytes, bytearray, memoryview, lambda data: np.frombuffer(data, dtype=np.uint8)])
def test_decoding_takes_all_buffers(wrap: Any) -> None:
    assert codec.decode("std_msgs/Int16", wrap(b"\1\2")) == {"data": 513}
