# SPDX-License-Identifier: BSD-3-Clause
import subprocess
from pathlib import Path

import pytest

import rules
from ros_support import REPOSITORY


@pytest.mark.parametrize(("spelling", "kind"), [("byte", "kInt8"), ("char", "kUint8"), ("float32", "kFloat32")])
def test_builtin_types_have_their_kind(spelling: str, kind: str) -> None:
    assert rules.field_row("x", spelling, False, None).kind == kind


def test_other_types_are_messages_by_name() -> None:
    row = rules.field_row("pose", "geometry_msgs/Pose", False, None)
    assert (row.kind, row.message) == ("kMessage", '"geometry_msgs/Pose"')


@pytest.mark.parametrize(
    ("is_array", "length", "array", "count"),
    [(False, None, "kNone", 0), (True, None, "kVariable", 0), (True, 36, "kFixed", 36), (True, 0, "kFixed", 0)],
)
def test_arrays_are_distinguished(is_array: bool, length: int | None, array: str, count: int) -> None:
    row = rules.field_row("x", "float64", is_array, length)
    assert (row.array, row.length) == (array, count)


def test_every_kind_of_the_table_is_in_the_header() -> None:
    header = (REPOSITORY / "include" / "bubblesim" / "messages" / "message_type.hpp").read_text()
    assert [kind for kind in rules.FIELD_KINDS.values() if f"  {kind}," not in header] == []


@pytest.mark.parametrize(
    ("value", "text"),
    [(True, '"1"'), (False, '"0"'), (2**64 - 1, '"18446744073709551615"'), (-1, '"-1"'), (0.1, '"0.1"'), ("a", '"a"')],
)
def test_constants_lose_nothing(value: bool | int | float | str, text: str) -> None:
    kinds = {bool: "bool", int: "uint64", float: "float64", str: "string"}
    assert rules.constant_row("X", kinds[type(value)], value).value == text


def test_names_of_string_constants_lose_their_blanks() -> None:
    assert rules.constant_row("NAME ", "string", "x").name == '"NAME"'


@pytest.mark.parametrize(
    "text", ["", "a", 'say "hi"\\n', "two\nlines\n", "tab\tbell\a7", "a\r\nb", "??/ ??=", "grün €", '%d {} )"']
)
def test_cpp_strings_mean_the_same_text(text: str, tmp_path: Path) -> None:
    program = tmp_path / "text.cpp"
    program.write_text(f"#include <cstdio>\nint main() {{ std::fputs({rules.cpp_string(text)}, stdout); }}\n")
    subprocess.run(["g++", "-std=c++17", program, "-o", tmp_path / "text"], check=True)
    printed = subprocess.run([tmp_path / "text"], capture_output=True, check=True).stdout
    assert printed.decode() == text
