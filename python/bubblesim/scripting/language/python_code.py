# SPDX-License-Identifier: BSD-3-Clause
"""The code of a child script in Python, in its own module."""

from __future__ import annotations

import difflib
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from types import CodeType, FunctionType, ModuleType, SimpleNamespace
from typing import Any

from bubblesim.messages.names import did_you_mean, unknown_attribute
from bubblesim.scripting.api.absent_modules import ABSENT
from bubblesim.scripting.language import script_output
from bubblesim.scripting.language.script_errors import called_wrongly, missing_module, without_self
from bubblesim.scripting.language.script_output import Source
from bubblesim.scripting.language.source import ScriptSourceError, find_file, read_text
from bubblesim.scripting.threads.script_thread import ScriptThread

_OUR_FOLDER = str(Path(__file__).parents[2])


class _Self(SimpleNamespace):
    """The object `self` of a script, to which its functions give attributes."""

    def __getattr__(self, name: str) -> Any:
        near = did_you_mean([f"self.{known}" for known in difflib.get_close_matches(name, list(vars(self)), n=2)])
        raise unknown_attribute(f"self.{name} is not set in this script{near}")


class PythonCode:
    """See ScriptCode."""

    def __init__(
        self,
        file: Path,
        text: str,
        search_paths: list[Path],
        modules: dict[str, Any],
        name: str,
        source: Source,
        *,
        read: Callable[[Path], str] = read_text,
    ) -> None:
        """Compile the ``text`` of ``file`` without running it.

        The first line may be ``#python``; the following lines may be ``include NAME`` (no quotes, no extension), which
        is searched in the script's folder and then in ``search_paths``; includeRel and includeAbs, old names, are the
        same.

        :param modules: the globals ``sim``, ``simROS``, ``simROS2`` of the script.
        :param name: name of the script's module.
        :param source: where printed lines come from.
        :param read: reads an included file.
        :raises ScriptSourceError: for a missing file or a syntax error.
        """
        self._read = read
        self._parts = self._compile(file, text, [file.parent, *search_paths], including=())
        self._modules = modules
        self._name = name
        self._folder = file.parent
        script_output.sources[name] = source
        # A real module, because dataclasses and pickle look up the module of a class.
        module = ModuleType(name)
        sys.modules[name] = module
        self._globals: dict[str, Any] = module.__dict__
        self._globals.update(modules, __file__=str(file), self=_Self(), require=self._require)

    @property
    def is_confined(self) -> bool:
        """Return whether the language prevents access to files and processes."""
        return False

    def run(self) -> None:
        """Run the included files and then the script's own code."""
        for part in self._parts:
            exec(part, self._globals)

    def execute(self, text: str) -> Any:
        """Run code with the script's globals; return the value of an expression."""
        try:
            code = compile(text.strip(), "<string>", "eval", dont_inherit=True)
        except SyntaxError:
            exec(compile(text, "<string>", "exec", dont_inherit=True), self._globals)
            return None
        return eval(code, self._globals)

    def function(self, name: str) -> Callable[..., Any] | None:
        """Return a global of the script."""
        return self._globals.get(name)

    def functions_by_name(self) -> dict[str, str]:
        """Return the global functions of the script with FILE:LINE of each, or an empty string if unknown."""
        return {name: _place_of(value) for name, value in self._globals.items() if callable(value)}

    def make_thread(self, name: str, body: Callable[..., Any], prepare: Callable[[], object]) -> ScriptThread:
        """Create an operating system thread that calls ``prepare`` and then ``body``, a function of the script."""

        def run() -> None:
            prepare()
            body()

        return ScriptThread(name, run)

    def was_interrupted(self, error: BaseException) -> bool:
        """Return whether the script failed because it was interrupted."""
        return isinstance(error, KeyboardInterrupt)

    def where_now(self, thread: int) -> str:
        """Return FILE:LINE of the script that runs in another thread, or an empty string."""
        frame = sys._current_frames().get(thread)
        while frame is not None and frame.f_globals.get("__name__") != self._name:
            frame = frame.f_back
        return f"{frame.f_code.co_filename}:{frame.f_lineno}" if frame is not None else ""

    def place(self, error: BaseException) -> str:
        """Return FILE:LINE where the script failed, or an empty string."""
        frames = _without_our_frames(traceback.TracebackException.from_exception(error)).stack
        return f"{frames[-1].filename}:{frames[-1].lineno}" if frames else _place_of(self._called_wrongly(error))

    def report(self, error: BaseException) -> str:
        """Return the error message and the calls."""
        report = "".join(_without_our_frames(traceback.TracebackException.from_exception(error)).format()).rstrip()
        return report + self._cure(error)

    def reason(self, error: BaseException) -> str:
        """Return the error message, in one line."""
        return traceback.format_exception_only(error)[-1].strip() + self._cure(error)

    def _cure(self, error: BaseException) -> str:
        return missing_module(error, self._folder, self._globals) or without_self(self._called_wrongly(error))

    def _called_wrongly(self, error: BaseException) -> FunctionType | None:
        return called_wrongly(error, self._globals)

    def _require(self, name: str) -> Any:
        """Return the module `sim`, `simROS` or `simROS2`; a version as in 'sim-1' is ignored."""
        bare = name.partition("-")[0]
        if bare in ABSENT:
            raise ImportError(ABSENT[bare])
        if bare not in self._modules:
            raise ImportError(f"module '{name}' not found; require supports {', '.join(self._modules)}")
        return self._modules[bare]

    def _compile(self, file: Path, text: str, folders: list[Path], including: tuple[Path, ...]) -> list[CodeType]:
        file = file.resolve()
        if file in including:
            raise ScriptSourceError(f"{file}: the file includes itself through {including[-1]}")
        lines = text.splitlines(keepends=True)
        parts: list[CodeType] = []
        for number, line in enumerate(lines):
            words = line.split()
            if len(words) == 2 and words[0] in ("include", "includeRel", "includeAbs"):
                name = words[1] if words[1].endswith(".py") else f"{words[1]}.py"
                try:
                    included = find_file(name, folders)
                except ScriptSourceError as error:
                    raise ScriptSourceError(f"{file}:{number + 1}: {error}") from None
                parts += self._compile(included, self._read(included), folders, (*including, file))
                lines[number] = "\n"  # keeps the following line numbers
            elif words and not line.startswith("#"):
                break  # end of the header
        parts.append(_compiled("".join(lines), file))
        return parts


def _place_of(function: object) -> str:
    code = getattr(function, "__code__", None)
    return f"{code.co_filename}:{code.co_firstlineno}" if isinstance(code, CodeType) else ""


def _compiled(text: str, file: Path) -> CodeType:
    try:
        # A script does not inherit this file's __future__ imports.
        return compile(text, str(file), "exec", dont_inherit=True)
    except SyntaxError as error:
        place = f"{error.filename or file}:{error.lineno or 1}"
        shown = f"\n    {error.text.strip()}" if error.text else ""
        raise ScriptSourceError(f"{place}: {type(error).__name__}: {error.msg}{shown}") from error
    except (ValueError, RecursionError, MemoryError) as error:
        raise ScriptSourceError(f"{file}:1: {error}") from error


def _without_our_frames(report: traceback.TracebackException) -> traceback.TracebackException:
    """Remove the frames of this package, keeping those of the script; also in causes."""
    kept = [frame for frame in report.stack if not frame.filename.startswith(_OUR_FOLDER)]
    report.stack = traceback.StackSummary.from_list(kept)
    for earlier in (report.__cause__, report.__context__):
        if earlier is not None:
            _without_our_frames(earlier)
    return report
