# SPDX-License-Identifier: BSD-3-Clause
"""The functions of scripts in general: each is documented and checks its arguments."""

import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from bubblesim.scripting.api import kinds
from bubblesim.scripting.api.checked_calls import ArgumentError, checked_on_failure, value_first
from bubblesim.scripting.api.functions import MODULES, functions, script_module
from bubblesim.scripting.api.ik.ik_module import SimIk
from bubblesim.scripting.api.ompl.ompl_module import SimOmpl
from bubblesim.scripting.api.reference import page
from bubblesim.scripting.api.ros.ros_modules import SimRos, SimRos2
from bubblesim.scripting.api.sim.sim_module import SimApi
from bubblesim.scripting.api.ui.ui_module import SimUi
from bubblesim.scripting.api.vision.vision_module import SimVision
from node_support import run_script, run_sim, write
from ros_support import REPOSITORY, free_port, ros_environment

ANYTHING = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.binary(),
    lambda inner: st.lists(inner, max_size=8) | st.dictionaries(st.text(max_size=3), inner, max_size=3),
    max_leaves=8,
)
# On a busy machine, examples take their time.
AT_LEISURE = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])


@script_module("sample")
class Sample:
    """Functions that return their arguments."""

    def number(self, value: float) -> float:
        """Any number."""
        return value

    @checked_on_failure
    def next(self, value: float) -> float:
        """The number after it."""
        return value + 1.0

    def text(self, value: str, count: int = 1) -> str:
        """A string, several times."""
        return value * count

    def vector(self, value: kinds.Vector3) -> list[float]:
        """Three numbers."""
        return value

    @value_first
    def moved(self, handle: kinds.Handle, value: kinds.Vector3, reference: kinds.Handle = -1) -> tuple[object, ...]:
        """Both orders."""
        return handle, value, reference


@script_module("forward")
class Forward:
    """A function with a readable annotation, and one without."""

    def number(self, value: float) -> float:
        """Any number."""
        return value

    def unknown(self, value: "NotThere") -> None:  # type: ignore[name-defined]  # noqa: F821
        """Nothing."""


del MODULES["sample"], MODULES["forward"]  # other tests check all modules


def refusal(function: Callable[[Any], object], value: object) -> str | None:
    """Return the error message for a rejected value, None for an accepted one."""
    try:
        function(value)
    except ArgumentError as error:
        return str(error)
    return None


@AT_LEISURE
@given(ANYTHING)
@example(b"0")
@example("0")
def test_numbers_and_only_they_are_taken_for_numbers(value: object) -> None:
    reported = refusal(Sample().number, value)
    if isinstance(value, int | float) and abs(value) < 1e308:
        assert reported is None
    elif isinstance(value, str | bytes | list | dict | None):
        assert reported is not None
        assert reported.startswith("sample.number: argument 1, value: expected a number, found ")


@AT_LEISURE
@given(st.lists(st.floats(allow_nan=False), max_size=5))
def test_lists_of_at_least_three_numbers_are_taken_for_vectors(values: list[float]) -> None:
    if len(values) >= 3:  # those behind them are ignored, as in CoppeliaSim
        assert Sample().vector(values) == values[:3]
    else:
        with pytest.raises(ArgumentError, match=r"^sample\.vector: argument 1, value: expected 3 numbers, found "):
            Sample().vector(values)


@AT_LEISURE
@given(st.lists(st.floats(), max_size=5), st.text() | st.none(), st.integers(0, 5))
def test_lists_with_anything_but_numbers_are_no_vectors(numbers: list[object], other: object, place: int) -> None:
    with pytest.raises(ArgumentError, match=r"^sample\.vector: argument 1, value: expected 3 numbers, found "):
        Sample().vector([*numbers[:place], other, *numbers[place:]])  # type: ignore[list-item]


def test_both_orders_of_older_and_newer_scripts_are_taken() -> None:
    expected = (5, [1.0, 2.0, 3.0], 7)
    assert Sample().moved(5, [1, 2, 3], 7) == expected
    assert Sample().moved(5, 7, [1, 2, 3]) == expected  # type: ignore[arg-type]
    assert Sample().moved(5, [1, 2, 3]) == (5, [1.0, 2.0, 3.0], -1)


@pytest.mark.parametrize(
    ("arguments", "reported"),
    [
        ((), "sample.text(value, count): missing a required argument: 'value'"),
        (("a", 1, 2), "sample.text(value, count): too many positional arguments"),
        (("a", 1.5), "sample.text: argument 2, count: expected an integer, found float 1.5"),
        ((None,), "sample.text: argument 1, value: expected a string, found nothing (None)"),
    ],
)
def test_a_call_that_does_not_fit_is_reported(arguments: tuple[object, ...], reported: str) -> None:
    with pytest.raises(ArgumentError) as error:
        Sample().text(*arguments)  # type: ignore[arg-type]
    assert str(error.value) == reported


def test_arguments_may_be_named() -> None:
    assert Sample().text(count=3, value="ab") == "ababab"


def test_annotations_of_a_function_are_read_at_its_first_use() -> None:
    assert [function.name for function in functions(Forward)] == ["number", "unknown"]
    assert Forward().number(1.0) == 1.0
    with pytest.raises(NameError, match="NotThere"):
        Forward().unknown(1)


def test_checks_of_a_function_are_made_once() -> None:
    assert Sample.number is Sample.number
    assert inspect.isfunction(vars(Sample)["number"])


MODULES = {
    "sim": SimApi,
    "simUI": SimUi,
    "simIK": SimIk,
    "simOMPL": SimOmpl,
    "simVision": SimVision,
    "simROS": SimRos,
    "simROS2": SimRos2,
}


@pytest.mark.parametrize(
    "function",
    [pytest.param(f, id=f"{name}.{f.name}") for name, module in MODULES.items() for f in functions(module)],
)
def test_every_function_states_what_it_does(function: object) -> None:
    assert function.doc.strip()  # type: ignore[attr-defined]
    assert all(p.annotation is not inspect.Parameter.empty for p in function.signature.parameters.values())  # type: ignore[attr-defined]


@pytest.mark.parametrize("name", MODULES)
def test_the_reference_page_is_that_of_the_functions(name: str) -> None:
    file = REPOSITORY / "docs" / "child_scripts" / f"{name}.md"
    assert file.read_text() == page(name), f"write it anew: python -m bubblesim.scripting.api.reference {name} > {file}"


SWEEP = """
    ODD = [None, True, -5, 10**30, float('nan'), 'text', b'bytes', [], [None], [1, 2, 3], {}, {'a': 1}, print]
    EXCEPT = ('stopSimulation', 'pauseSimulation', 'launchExecutable', 'waitForService', 'addScript', 'createScript')
    def sysCall_init():
        for module in MODULES:
            names = [n for n in dir(module) if callable(getattr(module, n)) and n[0] != '_' and n not in EXCEPT]
            assert len(names) > 20
            for name in names:
                for arguments in [(), *((a,) for a in ODD), *((a, b) for a in ODD for b in ODD)]:
                    try:
                        getattr(module, name)(*arguments)
                    except (TypeError, ValueError, LookupError, RuntimeError) as error:
                        assert str(error) and 'incompatible function arguments' not in str(error), (name, arguments)
        print('swept')
"""


def test_no_function_of_sim_falls_over_odd_arguments(tmp_path: Path) -> None:
    run = run_script(
        tmp_path, SWEEP.replace("MODULES", "[sim, simUI, simIK, simOMPL, simVision]"), "--strict", until=0.05
    )
    assert run.returncode == 0, run.stderr
    assert run.stdout.endswith("swept\n")


def test_no_function_of_simros_falls_over_odd_arguments(tmp_path: Path) -> None:
    script = write(tmp_path / "script.py", SWEEP.replace("MODULES", "[simROS, simROS2]"))
    options = ["--strict", "--speed", "max", "--until", 0.05, "--child-script", f"/Ball={script}"]
    run = run_sim("ball", *options, env=ros_environment(free_port(), tmp_path))  # no master is needed
    assert run.returncode == 0, run.stderr
    assert run.stdout.endswith("swept\n")


def test_a_function_that_is_checked_on_failure_reports_as_the_others() -> None:
    assert Sample().next(1.5) == 2.5
    with pytest.raises(ArgumentError, match=r"sample\.next: argument 1, value: expected a number, found str 'one'"):
        Sample().next("one")  # type: ignore[arg-type]
    with pytest.raises(ArgumentError, match=r"sample\.next\(value\): missing a required argument: 'value'"):
        Sample().next()  # type: ignore[call-arg]
    with pytest.raises(ArgumentError, match="unexpected keyword argument 'number'"):
        Sample().next(1.5, number=2)  # type: ignore[call-arg]
    assert Sample().next(value=1.5) == 2.5


def test_names_that_there_are_not_are_reported_with_those_that_come_near() -> None:
    with pytest.raises(AttributeError, match=r"sample has no numbr; did you mean sample\.number\?$"):
        Sample().numbr  # type: ignore[attr-defined]  # noqa: B018
    assert not hasattr(Sample(), "createCollection")
