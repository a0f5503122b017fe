# SPDX-License-Identifier: BSD-3-Clause
"""The prompt of the page: one call of a function of ``sim``.

A line such as ``sim.getObjectPosition(sim.getObject('/Tricycle'), -1)`` is parsed, never evaluated as Python: arguments
are numbers, strings, lists, dicts, constants of ``sim`` and further calls. Lua's ``{1, 2, 3}`` is a list, too.
"""

from __future__ import annotations

import ast
from typing import Any

from bubblesim.scripting.api.functions import MODULES
from bubblesim.scripting.api.sim import sim_module  # noqa: F401  # register it
from bubblesim.web.access import is_read_only

_MOST_CHARACTERS = 10_000
_MOST_CALLS = 20
_WORDS = {"nil": None, "true": True, "false": False}


class CommandError(ValueError):
    """A line that is not a call."""


async def run(page: Any, line: str) -> str:
    """Carry out a line and return its result as a string."""
    return shown(await _value(page, parse(line)))


def parse(line: str) -> ast.expr:
    """Return the call in a line.

    :raises CommandError: for everything else.
    """
    if len(line) > _MOST_CHARACTERS:
        raise CommandError(f"a line has at most {_MOST_CHARACTERS} characters")
    try:
        tree = ast.parse(line.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise CommandError(f"this is not a call such as sim.getObject('/Robot'): {error}") from None
    _check(tree, top=True)
    if sum(isinstance(node, ast.Call) for node in ast.walk(tree)) > _MOST_CALLS:
        raise CommandError(f"a line has at most {_MOST_CALLS} calls")
    return tree


def _check(node: ast.expr, *, top: bool = False) -> None:
    if isinstance(node, ast.Call):
        if _name_in_sim(node.func) is None:
            raise CommandError("only functions of sim can be called here, for example sim.getSimulationTime()")
        if node.keywords:
            raise CommandError("arguments are given by their position, not by name")
        for argument in node.args:
            _check(argument)
    elif top and not _name_in_sim(node):
        raise CommandError("type a call such as sim.getSimulationTime()")
    elif isinstance(node, ast.List | ast.Tuple | ast.Set):
        for element in node.elts:
            _check(element)
    elif isinstance(node, ast.Dict):
        for key, value in zip(node.keys, node.values, strict=True):
            if not isinstance(key, ast.Constant):
                raise CommandError("the names of a table are strings")
            _check(value)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.UAdd):
        _check(node.operand)
    elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr | ast.Add):  # flags
        _check(node.left)
        _check(node.right)
    elif not (isinstance(node, ast.Constant) or _name_in_sim(node) or _is_word(node)):
        raise CommandError(f"'{ast.unparse(node)}' is not a number, text, list, constant of sim or call of sim")


def _name_in_sim(node: ast.expr) -> str | None:
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "sim":
        return None if node.attr.startswith("_") else node.attr
    return None


def _is_word(node: ast.expr) -> bool:
    return isinstance(node, ast.Name) and node.id in _WORDS


async def _value(page: Any, node: ast.expr) -> Any:
    if isinstance(node, ast.Call):
        function = f"sim.{_name_in_sim(node.func)}"
        if not page.may_edit and not is_read_only(function):
            raise CommandError(f"{function}: this window is read-only")
        return await page.node.call(function, *[await _value(page, argument) for argument in node.args])
    if isinstance(node, ast.Constant):
        return node.value
    if isinstance(node, ast.List | ast.Tuple | ast.Set):
        return [await _value(page, element) for element in node.elts]
    if isinstance(node, ast.Dict):
        keys = [key.value for key in node.keys if isinstance(key, ast.Constant)]
        return dict(zip(keys, [await _value(page, value) for value in node.values], strict=True))
    if isinstance(node, ast.UnaryOp):
        value = _number(await _value(page, node.operand))
        return -value if isinstance(node.op, ast.USub) else value
    if isinstance(node, ast.BinOp):
        left, right = _number(await _value(page, node.left)), _number(await _value(page, node.right))
        return left + right if isinstance(node.op, ast.Add) else int(left) | int(right)
    if isinstance(node, ast.Name):
        return _WORDS[node.id]
    name = _name_in_sim(node) or ""
    value = getattr(MODULES["sim"], name, None)
    if not isinstance(value, int):
        raise CommandError(f"sim.{name} is not a constant; to call a function, add ()")
    return value


def _number(value: Any) -> Any:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise CommandError(f"{value!r} is not a number")
    return value


def shown(value: Any, depth: int = 0) -> str:
    """Return a result as a string: few digits, and bytes as their number."""
    if isinstance(value, bytes):
        return f"<{len(value)} bytes>"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, dict) and depth < 5:
        inside = ", ".join(f"{key}: {shown(each, depth + 1)}" for key, each in value.items())
        return f"{{{inside}}}"
    if isinstance(value, list | tuple) and depth < 5:
        parts = [shown(each, depth + 1) for each in value[:200]]
        more = [f"... {len(value) - 200} more"] if len(value) > 200 else []
        return f"[{', '.join([*parts, *more])}]"
    return "nothing" if value is None and depth == 0 else repr(value)
