# SPDX-License-Identifier: BSD-3-Clause
"""Broken definitions and lists of types are refused with the documented errors, and nothing else."""

import contextlib
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bubblesim.messages.lists import read_list
from bubblesim.messages.ros2_definitions import DefinitionError, read_parts
from damaged_text import damaged

DEFINITIONS = [
    '# a comment\nstd_msgs/Header header\nfloat64[9] k 1.5\nstring<=10 name "it\'s"\nuint8 A=1\nstring S = #x\n',
    "int32[<=3] bounded [1, 2, 3]\nwstring wide\nbool on true\ngeometry_msgs/Pose[] poses\nfloat32 ratio 1e3\n",
    "char c\nbyte b 255\nint64 I=-0x7f\ntime stamp\nduration d\nunique_identifier_msgs/UUID goal_id\n",
]
LISTS = [
    "# all\nstd_msgs/String # text\n\ngeometry_msgs/msg/Twist\nstd_srvs/srv/SetBool\n",
    "std_msgs/Bool\nstd_msgs/Bool\n",
]


@given(
    damaged([*DEFINITIONS, "---\n".join(DEFINITIONS[:2]), "---\n".join(DEFINITIONS)]),
    st.sampled_from(["msg", "srv", "action"]),
)
def test_a_definition_is_read_or_refused_with_its_line(text: str, folder: str) -> None:
    with contextlib.suppress(DefinitionError):
        for message in read_parts(text, "my_msgs/Thing", folder):
            for _, kind in message.fields:
                assert kind.base


@given(damaged(LISTS).map(lambda text: text.encode(errors="surrogatepass")))
def test_each_line_of_a_list_is_an_entry_or_a_problem(content: bytes) -> None:
    problems: list[str] = []
    with TemporaryDirectory() as folder:
        file = Path(folder, "messages.txt")
        file.write_bytes(content)
        entries = read_list(file, "messages.txt", problems, [])
    assert all(entry.name.count("/") == 1 for entry in entries)
    assert all(problem.startswith("messages.txt:") for problem in problems)


def test_a_default_value_that_its_type_cannot_hold_is_refused() -> None:
    with pytest.raises(DefinitionError, match=r"line 1: default value '1e39' of a float32: float too large"):
        read_parts("float32 ratio 1e39\n", "my_msgs/Thing", "msg")


def test_a_line_that_is_not_utf_8_is_a_problem_with_its_place(tmp_path: Path) -> None:
    file = tmp_path / "messages.txt"
    file.write_bytes(b"std_msgs/String  # caf\xe9\nstd_msgs/B\xe9\n")
    problems: list[str] = []
    assert [entry.name for entry in read_list(file, "messages.txt", problems, [])] == ["std_msgs/String"]
    assert [problem.partition(":")[2].partition(":")[0] for problem in problems] == ["2"]
