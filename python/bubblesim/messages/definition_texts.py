# SPDX-License-Identifier: BSD-3-Clause
"""Definition texts inside what was generated from them: C++ headers and Python classes. Nothing is compiled or run."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

_SEPARATOR = "=" * 80 + "\n"  # between a type's own text and those of its nested types
_LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')
_DEFINITION = re.compile(r"struct Definition<.*?return\s+((?:\"(?:[^\"\\]|\\.)*\"\s*)+);", re.DOTALL)
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r"}


def header_definition(header: Path) -> str | None:
    """The type's own text that gencpp put into a message header, None when there is none."""
    match = _DEFINITION.search(header.read_text(encoding="utf-8", errors="surrogateescape"))
    if match is None:
        return None
    text = "".join(_LITERAL.findall(match[1]))
    return _own_text(re.sub(r"\\(.)", lambda escape: _ESCAPES.get(escape[1], escape[1]), text))


def class_definition(module: Path, class_name: str) -> str | None:
    """The type's own text that genpy put into a message class, None when there is none."""
    try:
        tree = ast.parse(module.read_bytes())
    except (SyntaxError, ValueError):
        return None
    for name, value in _class_attributes(tree, class_name):
        if name == "_full_text" and isinstance(value, ast.Constant) and isinstance(value.value, str):
            return _own_text(value.value)
    return None


def _class_attributes(tree: ast.Module, class_name: str) -> Iterator[tuple[str, ast.expr]]:
    classes = (node for node in tree.body if isinstance(node, ast.ClassDef) and node.name == class_name)
    for statement in (statement for node in classes for statement in node.body):
        if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name):
            yield statement.targets[0].id, statement.value


def _own_text(full_definition: str) -> str:
    return full_definition.split(_SEPARATOR, 1)[0]
