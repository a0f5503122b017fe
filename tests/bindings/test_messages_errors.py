# SPDX-License-Identifier: BSD-3-Clause
"""Error messages for messages that do not fit their type."""

from typing import Any

import numpy as np
import pytest

from message_support import codec


def error(name: str, message: Any) -> str:
    """Return the text of the error that encoding raises."""
    with pytest.raises(codec.MessageError) as caught:
        codec.encode(name, message)
    return str(caught.value)


def test_errors_are_value_errors() -> None:
    assert issubclass(codec.MessageError, ValueError)


def test_a_wrong_value_is_located_by_type_and_path() -> None:
    message = {"pose": {"pose": {"position": {"x": "abc"}}}}
    expected = "geometry_msgs/PoseWithCovarianceStamped: pose.pose.position.x: expected float64, found str 'abc'"
    assert error("geometry_msgs/PoseWithCovarianceStamped", message) == expected


def test_elements_are_located_by_index() -> None:
    message = {"transforms": [{}, {"header": {"frame_id": 7}}]}
    assert (
        error("tf2_msgs/TFMessage", message)
        == "tf2_msgs/TFMessage: transforms[1].header.frame_id: expected string, found int 7"
    )


@pytest.mark.parametrize(
    ("name", "value", "text"),
    [
        ("Int8", 128, "expected int8 (-128 to 127), found int 128"),
        ("UInt8", -1, "expected uint8 (0 to 255), found int -1"),
        ("Int32", 2**31, "expected int32 (-2147483648 to 2147483647), found int 2147483648"),
        ("Int64", 2**63, "expected int64 (-9223372036854775808 to 9223372036854775807), found int 9223372036854775808"),
        ("UInt64", 2**64, "expected uint64 (0 to 18446744073709551615), found int 18446744073709551616"),
        ("UInt64", -1, "expected uint64 (0 to 18446744073709551615), found int -1"),
        ("Int32", 2.0**31, "expected int32 (-2147483648 to 2147483647), found float 2147483648.0"),
        ("UInt8", -1.5, "expected uint8 (0 to 255), found float -1.5"),
        ("Int32", float("inf"), "expected int32 (-2147483648 to 2147483647), found float inf"),
        ("UInt64", float("-inf"), "expected uint64 (0 to 18446744073709551615), found float -inf"),
        ("Bool", 0.5, "expected bool, found float 0.5"),
        ("Int32", float("nan"), "expected int32 (-2147483648 to 2147483647), found float nan"),
        ("Int32", None, "expected int32 (-2147483648 to 2147483647), found None"),
        ("Float32", 1e39, "expected float32 (finite or inf), found float 1e+39"),
        ("Float64", 10**400, "expected float64, found int 1000"),
        ("Float64", [1.0], "expected float64, found list of 1"),
        ("Bool", 2, "expected bool, found int 2"),
        ("Bool", "true", "expected bool, found str 'true'"),
        ("String", 1.5, "expected string, found float 1.5"),
        ("String", "\ud800", "expected string that UTF-8 can express, found str '\\ud800'"),
        ("Time", -0.5, "expected seconds as uint32 (0 to 4294967295), found float -0.5"),
        ("Time", float("nan"), "expected seconds as uint32 (0 to 4294967295), found float nan"),
        ("Time", "now", "expected time: seconds, {'secs', 'nsecs'} or {'sec', 'nanosec'}, found str 'now'"),
        ("Time", {"secs": 1, "nanos": 2}, "expected keys 'secs' and 'nsecs' or 'sec' and 'nanosec', found str 'nanos'"),
        ("Duration", 1e10, "expected seconds as int32 (-2147483648 to 2147483647), found float 10000000000.0"),
    ],
)
def test_wrong_values_are_shown_with_what_was_expected(name: str, value: object, text: str) -> None:
    assert error(f"std_msgs/{name}", {"data": value}).startswith(f"std_msgs/{name}: data: {text}")


def test_parts_of_times_are_range_checked() -> None:
    assert "data.nsecs: expected uint32" in error("std_msgs/Time", {"data": {"secs": 0, "nsecs": -1}})


@pytest.mark.parametrize("count", [0, 35, 37])
@pytest.mark.parametrize("make", [list, np.array])
def test_fixed_arrays_must_have_their_length(count: int, make: Any) -> None:
    expected = f"geometry_msgs/PoseWithCovariance: covariance: expected 36 elements, found {count}"
    assert error("geometry_msgs/PoseWithCovariance", {"covariance": make([0.0] * count)}) == expected


@pytest.mark.parametrize("value", ["abc", b"abc", {"a": 1}, {1.0}, 3.0, None, np.float32(3), np.array(["a"])])
def test_arrays_of_floats_refuse_what_is_no_sequence_of_numbers(value: object) -> None:
    assert error("sensor_msgs/LaserScan", {"ranges": value}).startswith("sensor_msgs/LaserScan: ranges")


@pytest.mark.parametrize(
    ("values", "place", "found"),
    [
        ([1, 256], 1, "int 256"),
        (np.array([1, 2, -1]), 2, "-1"),
        (np.array([-1.0]), 0, "-1"),
        (np.array([0.0, np.inf]), 1, "inf"),
        (np.array([float("nan")]), 0, "nan"),
    ],
)
def test_array_elements_are_range_checked(values: Any, place: int, found: str) -> None:
    text = error("std_msgs/UInt8MultiArray", {"data": values})
    assert text.startswith(f"std_msgs/UInt8MultiArray: data[{place}]: expected uint8 (0 to 255), found {found}")


def test_float32_arrays_do_not_turn_large_numbers_into_infinity() -> None:
    assert "ranges[1]: expected float32" in error("sensor_msgs/LaserScan", {"ranges": np.array([1.0, 1e300])})


def test_text_for_bytes_must_be_latin_1() -> None:
    assert "expected uint8[] or str of characters below 256" in error("std_msgs/UInt8MultiArray", {"data": "€"})


def test_an_unknown_field_comes_with_a_hint_and_the_valid_names() -> None:
    assert error("geometry_msgs/PoseStamped", {"pose": {"positon": {}}}) == (
        "geometry_msgs/PoseStamped: pose: geometry_msgs/Pose has no field 'positon'; did you mean position? "
        "its fields: position, orientation"
    )


def test_an_unknown_field_that_resembles_none_comes_with_the_valid_names() -> None:
    assert error("std_msgs/String", {"data": "a", "timestamp": 1}) == (
        "std_msgs/String: std_msgs/String has no field 'timestamp'; its fields: data"
    )


def test_unknown_fields_of_empty_messages_are_refused() -> None:
    assert error("std_msgs/Empty", {"a": 1}) == "std_msgs/Empty: std_msgs/Empty has no field 'a'; its fields: none"


def test_keys_must_be_strings() -> None:
    assert error("std_msgs/String", {1: 2}).startswith("std_msgs/String: expected field names of std_msgs/String as ")


@pytest.mark.parametrize("message", [None, 1.5, [1], "text", {"linear": [1, 2, 3]}])
def test_messages_must_be_dicts(message: object) -> None:
    assert "expected dict with the fields of geometry_msgs/" in error("geometry_msgs/Twist", message)


def test_long_values_are_shortened() -> None:
    assert len(error("std_msgs/Float64", {"data": "x" * 100_000})) < 200


def test_unknown_types_name_the_list_and_the_command() -> None:
    with pytest.raises(codec.MessageError) as caught:
        codec.encode("geometry_msgs/Twits", {})
    assert str(caught.value) == (
        "geometry_msgs/Twits is not a message type of this build, and no definition was found on this machine; "
        "did you mean geometry_msgs/Twist?"
    )
    with pytest.raises(codec.MessageError) as caught:
        codec.encode("quantum_teleport_msgs/Beam", {})
    assert str(caught.value) == (
        "quantum_teleport_msgs/Beam is not a message type of this build, and no definition was found on this machine; "
        "to add it, install its package or add that to the workspace, and list it in meta/messages.txt: rosrun "
        "bubblesim add_message quantum_teleport_msgs/Beam"
    )


def test_unknown_services_name_their_list() -> None:
    with pytest.raises(codec.MessageError, match=r"did you mean std_srvs/SetBool\?$"):
        codec.service_type_hash("std_srvs/SetBol")
    with pytest.raises(codec.MessageError, match=r"to add it, .* in meta/services\.txt: rosrun"):
        codec.service_type_hash("quantum_teleport_srvs/Beam")


def test_unknown_types_may_have_meant_one_that_is_not_listed() -> None:
    with pytest.raises(codec.MessageError, match="did you mean shape_msgs/SolidPrimitive"):
        codec.type_hash("shape_msgs/SolidPrimitiv")


@pytest.mark.parametrize("name", ["Twist", "std_msgs/Twist"])
def test_the_right_type_of_the_wrong_package_is_recognised(name: str) -> None:
    with pytest.raises(codec.MessageError, match="did you mean geometry_msgs/Twist"):
        codec.type_hash(name)


def test_services_are_no_messages() -> None:
    with pytest.raises(codec.MessageError) as caught:
        codec.type_hash("std_srvs/SetBool")
    assert str(caught.value) == "std_srvs/SetBool is a service type, expected a message type"


def test_short_messages_state_what_is_missing_where() -> None:
    with pytest.raises(codec.MessageError) as caught:
        codec.decode("std_msgs/String", b"\5\0\0\0ab")
    assert str(caught.value) == "std_msgs/String: data: the message is truncated: expected 5 more bytes, found 2"


def test_long_messages_state_how_much_is_left() -> None:
    with pytest.raises(codec.MessageError) as caught:
        codec.decode("std_msgs/Int8", b"\1\2\3")
    assert str(caught.value) == "std_msgs/Int8: 2 surplus bytes after the last field"


@pytest.mark.parametrize("name", ["sensor_msgs/LaserScan", "tf2_msgs/TFMessage", "diagnostic_msgs/KeyValue"])
def test_absurd_counts_take_no_memory(name: str) -> None:
    with pytest.raises(codec.MessageError):
        codec.decode(name, codec.encode(name, {})[:-4] + b"\xff\xff\xff\xff")


def test_exceptions_of_a_values_own_code_pass_through() -> None:
    class Stubborn:
        def __float__(self) -> float:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        codec.encode("std_msgs/Float64", {"data": Stubborn()})


def test_a_value_that_cannot_be_shown_is_named_by_its_type() -> None:
    class Unshown:
        def __repr__(self) -> str:
            raise RuntimeError

        def __float__(self) -> float:
            raise TypeError

    assert "found " in error("std_msgs/Float64", {"data": Unshown()})
