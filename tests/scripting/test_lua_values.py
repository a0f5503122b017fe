# SPDX-License-Identifier: BSD-3-Clause
"""Conversion of Lua values to Python and back."""

from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from lupa import lua54

from bubblesim.scripting.language.lua_values import LuaFunction, LuaValues

LUA = lua54.LuaRuntime(encoding=None, unpack_returned_tuples=True, register_eval=False, register_builtins=False)
VALUES = LuaValues(LUA, lambda chunk, line: f"{chunk.decode()}:{line}", lambda _text: None)
VALUES.run_in_sandbox = LUA.eval(b"function(body, ...) return true, body(...) end")


def to_python(expression: str) -> Any:
    return VALUES.to_python(LUA.eval(expression.encode()))


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("nil", None),
        ("true", True),
        ("7 // 2", 3),
        ("7 / 2", 3.5),
        ("'text'", "text"),
        ("'\\xff\\0'", b"\xff\0"),
        ("'\\xc3\\xbc'", b"\xc3\xbc"),
        ("{1, 2.5, 'x'}", [1, 2.5, "x"]),
        ("{[2] = 'b', [1] = 'a'}", ["a", "b"]),
        ("{}", {}),
        ("{x = 1, y = {z = {}}}", {"x": 1, "y": {"z": {}}}),
        ("{1, 2, n = 2}", {1: 1, 2: 2, "n": 2}),
        ("{1, nil, 3}", {1: 1, 3: 3}),
        ("{[1.5] = true}", {1.5: True}),
    ],
)
def test_a_value_of_lua_is_one_of_python(expression: str, value: object) -> None:
    found = to_python(expression)
    assert found == value
    assert type(found) is type(value)


@pytest.mark.parametrize(
    ("value", "check"),
    [
        (None, "value == nil"),
        (True, "value == true"),
        (3, "math.type(value) == 'integer' and value == 3"),
        (3.0, "math.type(value) == 'float' and value == 3"),
        (2**64 - 1, "value == -1"),
        ("ü", "value == '\\xc3\\xbc'"),
        (b"\xff\0", "value == '\\xff\\0'"),
        (bytearray(b"a"), "value == 'a'"),
        ([1, [2, 3]], "#value == 2 and value[2][1] == 2"),
        ((4, 5), "value[1] == 4 and value[2] == 5"),
        ({"a": {"b": 1}}, "value.a.b == 1"),
        (np.array([1.5, 2.5], dtype=np.float32), "#value == 2 and value[1] == 1.5"),
        (np.array([[1, 2], [3, 4]]), "value[2][1] == 3"),
        (np.float64(0.5), "value == 0.5"),
    ],
)
def test_a_value_of_python_is_one_of_lua(value: object, check: str) -> None:
    holds = LUA.eval(f"function(value) return {check} end".encode())
    assert holds(VALUES.to_lua(value)) is True


trees = st.recursive(
    st.booleans()
    | st.integers(-(2**63), 2**63 - 1)
    | st.floats(allow_nan=False)
    | st.text(st.characters(max_codepoint=127)),
    lambda inner: (
        st.lists(inner, min_size=1) | st.dictionaries(st.text(st.characters(max_codepoint=127), min_size=1), inner)
    ),
    max_leaves=20,
)


# On a busy machine, examples take their time.
@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(trees)
def test_what_goes_to_lua_comes_back_as_it_was(value: object) -> None:
    assert VALUES.to_python(VALUES.to_lua(value)) == value


def test_a_function_of_lua_takes_and_returns_values_of_python() -> None:
    function = to_python("function(list, name) return #list, {[name] = list[1]}, nil end")
    assert isinstance(function, LuaFunction)
    assert function([7, 8], "first") == (2, {"first": 7}, None)


def test_lua_gets_back_its_own_function() -> None:
    LUA.execute(b"function original() end")
    function = to_python("original")
    assert LUA.eval(b"function(value) return value == original end")(VALUES.to_lua(function)) is True


def test_a_table_that_holds_itself_is_an_error() -> None:
    LUA.execute(b"round = {} round[1] = round")
    with pytest.raises(ValueError, match="contains itself"):
        to_python("round")


def test_what_has_no_counterpart_is_an_error() -> None:
    with pytest.raises(TypeError, match="values of type object cannot be converted to Lua"):
        VALUES.to_lua(object())
    with pytest.raises(TypeError, match="Lua values of type userdata are not supported"):
        to_python("io.stdout")
