# SPDX-License-Identifier: BSD-3-Clause
"""The prompt of the page: what it carries out, and what it refuses to read as a call."""

import asyncio
from typing import Any

import pytest

from bubblesim.web import console


class Recorder:
    """Takes the calls that a line makes; answers with their number."""

    def __init__(self, *, may_edit: bool = True) -> None:
        self.may_edit = may_edit
        self.node = self
        self.calls: list[tuple[Any, ...]] = []

    async def call(self, function: str, *arguments: Any) -> int:
        self.calls.append((function, *arguments))
        return len(self.calls)


def run(line: str, *, may_edit: bool = True) -> list[tuple[Any, ...]]:
    page = Recorder(may_edit=may_edit)
    asyncio.run(console.run(page, line))
    return page.calls


def test_a_line_is_a_call_with_literals_constants_and_further_calls() -> None:
    assert run("sim.getSimulationTime()") == [("sim.getSimulationTime",)]
    assert run("sim.setJointTargetVelocity(sim.getObject('/Motor'), -1.5)") == [
        ("sim.getObject", "/Motor"),
        ("sim.setJointTargetVelocity", 1, -1.5),
    ]
    assert run("sim.f(sim.handle_all, [1, (2, 3)], {'a': 1}, True, None)") == [
        ("sim.f", -2, [1, [2, 3]], {"a": 1}, True, None)
    ]
    assert run("sim.f({1, 2}, true, nil, sim.drawing_lines | sim.drawing_cyclic)") == [
        ("sim.f", [1, 2], True, None, 0x1001)
    ]


@pytest.mark.parametrize(
    "line",
    [
        "1 + 1",
        "print('x')",
        "__import__('os').system('true')",
        "sim.getObject.__globals__",
        "sim.getObject('/a').real",
        "sim._caller",
        "sim._caller()",
        "sim.f(x)",
        "sim.f(lambda: 1)",
        "sim.f([x for x in (1, 2)])",
        "sim.f(a=1)",
        "sim.f(*[1])",
        "sim.f('a' + 'b')",
        "sim.f(9 ** 9)",
        "sim.f(f'{1}')",
        "sim.f(); sim.g()",
        "simROS.getTime()",
        "sim.f(" + "(" * 500,
        "sim.f(" * 50 + ")" * 50,
        "x" * 20000,
        "",
    ],
)
def test_everything_else_is_refused_without_a_call(line: str) -> None:
    page = Recorder()
    with pytest.raises(console.CommandError):
        asyncio.run(console.run(page, line))
    assert page.calls == []


def test_a_page_that_may_only_look_reads() -> None:
    assert run("sim.getObject('/a')", may_edit=False) == [("sim.getObject", "/a")]
    with pytest.raises(console.CommandError, match="is read-only"):
        run("sim.setObjectPosition(1, [0, 0, 0])", may_edit=False)
    with pytest.raises(console.CommandError, match="is read-only"):
        run("sim.getObjectPosition(sim.createDummy(1))", may_edit=False)


def test_results_are_short_texts() -> None:
    assert console.shown([0.1 + 0.2, b"abc", None]) == "[0.3, <3 bytes>, None]"
    assert console.shown(None) == "nothing"
    assert console.shown({"a": [1, "b"]}) == "{a: [1, 'b']}"
    assert console.shown(list(range(300))).endswith("... 100 more]")
