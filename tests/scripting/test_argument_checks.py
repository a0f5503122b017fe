# SPDX-License-Identifier: BSD-3-Clause
"""Any wrong argument of any function is reported with function, argument, expected and found value, in both languages,
without side effects."""

from collections.abc import Iterator
from pathlib import Path

from bubblesim.scripting.api.functions import MODULES, functions, kinds_of
from bubblesim.scripting.api.kinds import Kind
from bubblesim.scripting.api.ros import ros_modules  # noqa: F401  # registers modules
from bubblesim.scripting.api.sim import sim_module  # noqa: F401  # registers modules
from node_support import run_sim, write
from ros_support import DEADLINE, free_port, ros_environment

IN_PYTHON = """
    from hypothesis import HealthCheck, given, settings, strategies as st
    from bubblesim.scripting.api.checked_calls import ArgumentError
    from bubblesim.scripting.api.functions import functions, kinds_of

    ANYTHING = st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.binary() | st.just(print),
        lambda inner: st.lists(inner, max_size=8) | st.dictionaries(st.text(max_size=3), inner, max_size=3),
        max_leaves=8,
    )
    FITTING = [1, 'a', b'a', [1, 2], [1, 2, 3], [1, 2, 3, 4], [1] * 7, [1] * 12, {}, {'sec': 1, 'nanosec': 2}]

    def takes(kind, value):
        try:
            kind.convert(value)
        except (TypeError, ValueError, OverflowError):
            return False
        return True

    def fitting(kind):
        return next(value for value in FITTING if kind is None or takes(kind, value))

    def check(module, name, number, parameter, kind, before, after):
        # On a busy machine, examples take their time.
        @settings(max_examples=4, deadline=None, database=None, suppress_health_check=[HealthCheck.too_slow])
        @given(ANYTHING.filter(lambda value: not takes(kind, value)))
        def refuses(value):
            try:
                getattr(module, name)(*before, value, *after)
            except ArgumentError as error:
                start = f': argument {number}, {parameter}: expected {kind.words}, found '
                assert f'.{name}{start}' in str(error), str(error)
            else:
                raise AssertionError(f'{name} took {value!r} for {parameter}')
        refuses()

    def sysCall_init():
        checked = 0
        for module in (sim, simROS, simROS2):
            for function in functions(type(module)):
                kinds = kinds_of(type(module), function.name)
                required = [p.name for p in function.signature.parameters.values() if p.default is p.empty]
                before = []
                for number, (parameter, kind) in enumerate(kinds.items(), start=1):
                    if kind is not None:
                        after = [fitting(kinds[name]) for name in required[number:]]
                        check(module, function.name, number, parameter, kind, before, after)
                        checked += 1
                    if hasattr(getattr(type(module), function.name), 'checked_on_failure'):
                        break  # checks the arguments only after a failed call, which the first may cause
                    before.append(fitting(kind))
        print('checked', checked)
"""

# Lua values and their Python equivalents.
LUA_VALUES: list[tuple[str, object]] = [
    ("true", True),
    ("1.5", 1.5),
    ("'text'", "text"),
    ("'\\255'", b"\xff"),
    ("{}", {}),
    ("{1, 'a'}", [1, "a"]),
    ("{1, 2, 3}", [1, 2, 3]),
    ("{1, 2, 3, 4}", [1, 2, 3, 4]),
    ("{1, 2, 3, 4, 5, 6, 7}", [1, 2, 3, 4, 5, 6, 7]),
    (f"{{{', '.join('1' * 12)}}}", [1] * 12),
    ("{1, 2}", [1, 2]),
    ("{sec = 1, nanosec = 2}", {"sec": 1, "nanosec": 2}),
    ("7", 7),
    ("print", print),
]


def takes(kind: Kind | None, value: object) -> bool:
    try:
        return kind is None or kind.convert(value) is not kind
    except (TypeError, ValueError, OverflowError):
        return False


def fitting(kind: Kind | None) -> str:
    return next(text for text, value in LUA_VALUES if takes(kind, value))


def calls_in_lua() -> Iterator[tuple[str, str]]:
    """Yield wrong calls and the expected error messages."""
    for module_name, module in MODULES.items():
        if module_name not in ("sim", "simROS", "simROS2"):
            continue
        for function in functions(module):
            name = f"{module_name}.{function.name}"
            if name == "sim.wait":
                continue  # Lua has its own version
            kinds = kinds_of(module, function.name)
            required = [p.name for p in function.signature.parameters.values() if p.default is p.empty]
            before: list[str] = []
            for number, (parameter, kind) in enumerate(kinds.items(), start=1):
                after = [fitting(kinds[name]) for name in required[number:]]
                for text, value in LUA_VALUES:
                    if not takes(kind, value):
                        assert kind is not None
                        reported = f"{name}: argument {number}, {parameter}: expected {kind.words}, found "
                        yield f"{name}({', '.join([*before, text, *after])})", reported
                if hasattr(getattr(module, function.name), "checked_on_failure"):
                    break
                before.append(fitting(kind))


def run(folder: Path, name: str, code: str) -> list[str]:
    """Return what the script prints, in a node without a master."""
    script = write(folder / name, code)
    options = ["--strict", "--speed", "max", "--until", 0.05, "--child-script", f"/Ball={script}"]
    run = run_sim("ball", *options, env=ros_environment(free_port(), folder), timeout=12 * DEADLINE)
    assert run.returncode == 0, run.stderr
    return run.stdout.splitlines()


def test_python(tmp_path: Path) -> None:
    *_, last = run(tmp_path, "script.py", IN_PYTHON)
    assert int(last.removeprefix("checked ")) > 150


def test_lua(tmp_path: Path) -> None:
    calls = list(calls_in_lua())
    assert len(calls) > 1000
    code = ["local function try(call) print(select(2, pcall(call))) end", "function sysCall_init()"]
    # One function per call: a Lua function can have only a limited number of constants.
    code += [f"  (function() try(function() {call} end) end)()" for call, _ in calls]
    printed = run(tmp_path, "script.lua", "\n".join([*code, "end"]).replace("\n  (", "\n  ;("))
    printed = [line for line in printed if not line.startswith("plugin ")]
    for number, ((call, reported), line) in enumerate(zip(calls, printed, strict=True), start=3):
        assert line.startswith(f"{tmp_path}/script.lua:{number}: {reported}"), f"{call}\n{line}"
