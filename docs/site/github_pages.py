# SPDX-License-Identifier: BSD-3-Clause
"""Extension of Sphinx that reads pages written for GitHub.

What tests need and GitHub hides, comments such as ``<!-- in another terminal: COMMAND -->``, is shown; links to files
beside the documentation become their names.
"""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

_RUNNING = re.compile(r"^<!-- (?:in another terminal|beside): (.+?)(?:, until there is (\S+))? -->$", re.MULTILINE)
_FILE = re.compile(r"^<!-- file: (\S+) -->$", re.MULTILINE)
_LINK = re.compile(r"(?<!!)\[([^\]]*)\]\((?!https?:|#|mailto:)([^)#\s]+)(?:#[^)]*)?\)")


def shown_as_page(text: str, page: Path, docs: Path) -> str:
    """Return the text of a page of GitHub as that of the site.

    :param page: its file, to which links are relative.
    :param docs: the folder of all pages.
    """
    text = _RUNNING.sub(_running, text)
    text = _FILE.sub(r"**`\1`**", text)
    text = text.replace("```mermaid\n", "```text\n")
    parts = re.split(r"(^```.*?^```$)", text, flags=re.MULTILINE | re.DOTALL)
    return "".join(
        part if part.startswith("```") else _LINK.sub(lambda link: _linked(link, page, docs), part) for part in parts
    )


def _running(comment: re.Match[str]) -> str:
    wait = f" Wait until there is `{comment[2]}`." if comment[2] else ""
    return f"\n:::{{admonition}} Needs running\nIn another terminal: `{comment[1]}`.{wait}\n:::\n"


def _linked(link: re.Match[str], page: Path, docs: Path) -> str:
    """Return a link to a page or a file as it is, and one to a folder or a page elsewhere as words."""
    words, target = link[1], Path(os.path.normpath(page.parent / link[2]))
    is_inside = docs in target.parents
    if target.is_dir():
        index = target / "README.md"
        return f"[{words}]({link[2].rstrip('/')}/README.md)" if is_inside and index.is_file() else words
    if target == docs / "README.md":
        return f"[{words}]({os.path.relpath(docs / 'index.rst', page.parent)})"
    return link[0] if is_inside or target.suffix != ".md" else words


def _on_source_read(app: Sphinx, name: str, source: list[str]) -> None:
    page = Path(app.env.doc2path(name))
    if page.suffix == ".md":
        source[0] = shown_as_page(source[0], page, Path(app.srcdir))


def _on_docstring(_app: Sphinx, _what: str, _name: str, _object: object, _options: object, lines: list[str]) -> None:
    """Docstrings are plain text: |w| is an absolute value, no substitution, and file:line no address."""
    lines[:] = [line.replace("|", r"\|").replace("file:line", "``file:line``") for line in lines]


def setup(app: Sphinx) -> dict[str, Any]:
    """Connect to Sphinx."""
    app.connect("source-read", _on_source_read)
    app.connect("autodoc-process-docstring", _on_docstring)
    return {"parallel_read_safe": True}
