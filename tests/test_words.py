# SPDX-License-Identifier: BSD-3-Clause
"""Names, comments, messages and pages use the terms of ROS, Gazebo and CoppeliaSim: one word for each thing."""

import re
from collections.abc import Iterator
from pathlib import Path

from ros_support import REPOSITORY

# Words and parts of names, and what takes their place.
EVERYWHERE = {
    r"\bdoors?\b|door_|_door\b": "remote API server, connection",
    r"\blobby\b": "connections",
    r"is_looking|--look\b": "read-only",
    r"\btexts\b|\b[Aa] text\b": "string, message, document",
    r"\btable of Python\b": "dict",
    r"Context& (?!context_?\b)[a-z]": "context",
    r"PATIENCE|patience_|_patience\b|giving_way": "timeout, deadline, yielding",
    r"\btold_|_told\b|\btell_": "reported, notify",
    r"[Cc]omplain": "warning, problem, error",
    r"\bin_pass|RememberedPass|[a-z]InPasses": "step",
    r"FileWatch|input_files": "DescriptorWatch, descriptors",
    r"\b[Ww]hoever\b|\bkin\b|\bstrangers?\b": "user, client",
    r"\b(feels?|hears?|heard|speaks?|tells?|says|said)\b": "measures, receives, uses, notifies, states, logs",
    r"\b(say|tell)\(": "publish, send, log",
    r"_(feels?|hears?|heard|says?|said|speaks?|tells?|told)(_|\b)": "measures, receives, states, reports",
    r"(\b|[a-z])(Feels?|Hears?|Heard|Says?|Said|Speaks?|Tells?|Told)[A-Z]": "measures, receives, states, reports",
    r"\btwo looks\b|\blooks at (the|its) (socket|inbox|queue)": "polls",
    r"of the top level\b": "top-level",
}
IN_PAGES = {r"\b[Oo]nes? that\b": "the thing by its name", r"\bsay\b": "state, report"}
# Files in which such a word is meant.
MEANT = {
    "docs/ros/goals.md": "~patience, as move_base has planner_patience",
    "python/bubblesim/compat/move_base_settings.py": "planner_patience",
    "scenes/models/living_room/model.sdf": "a room has a door",
    "scripts/go_to.py": "~patience",
    "tests/slam/test_tricycle_goal.py": "~patience",
    "tests/test_words.py": "",
    "tests/web/test_view.py": "a room has a door",
}
FOLDERS = [
    "benchmarks",
    "docs",
    "include",
    "launch",
    "meta",
    "msg",
    "python",
    "scenes",
    "scripts",
    "src",
    "tests",
    "web/src",
]
SUFFIXES = {"", ".cpp", ".css", ".em", ".hpp", ".html", ".js", ".launch", ".lua", ".md", ".msg", ".py", ".sdf", ".srv"}


def files() -> Iterator[Path]:
    """Yield the files that people write; the changelog keeps the names of its time."""
    yield from (REPOSITORY / name for name in ("CMakeLists.txt", "CONTRIBUTING.md", "README.md", "package.xml"))
    for folder in FOLDERS:
        for file in sorted((REPOSITORY / folder).rglob("*")):
            if file.suffix in SUFFIXES and file.is_file() and "__pycache__" not in file.parts:
                yield file


def strays(words: dict[str, str], file: Path) -> Iterator[str]:
    """Yield where a file has one of the words, and what to write instead."""
    name = str(file.relative_to(REPOSITORY))
    if name in MEANT:
        return
    lines = [name, *file.read_text(errors="replace").splitlines()]
    for word, instead in words.items():
        for number, line in enumerate(lines):
            if found := re.search(word, line):
                yield f"{name}:{number}: '{found.group()}': {instead}"


def test_names_and_comments_use_the_terms_of_the_field() -> None:
    checked = list(files())
    assert len(checked) > 1000
    assert [stray for file in checked for stray in strays(EVERYWHERE, file)] == []


def test_pages_use_the_terms_of_the_field() -> None:
    pages = [file for file in files() if file.suffix == ".md"]
    assert [stray for page in pages for stray in strays(IN_PAGES, page)] == []


def test_words_are_found() -> None:
    page = REPOSITORY / "README.md"
    samples = (
        "the node speaks ROS",
        "self._patience",
        "void tell_all()",
        "a text",
        "const Context& moment",
        "complaint",
        "test_it_says_why",
        "TEST(Sensor, FeelsNothing)",
    )
    assert [sample for sample in samples if not any(re.search(word, sample) for word in EVERYWHERE)] == []
    assert list(strays({r"bubblesim": "x"}, page))
