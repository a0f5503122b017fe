# SPDX-License-Identifier: BSD-3-Clause
"""The code of a child script in Lua, with its own Lua state."""

from __future__ import annotations

import itertools
import os
import re
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

from lupa import lua54

from bubblesim.program.output import write_line
from bubblesim.scene_state import log
from bubblesim.scripting.api.absent_modules import ABSENT
from bubblesim.scripting.api.functions import MODULES, ScriptFunction, caller_of, functions
from bubblesim.scripting.api.missing_names import explain
from bubblesim.scripting.api.old_names import note_old_name, of_v_rep, present_name
from bubblesim.scripting.api.ros import no_ros
from bubblesim.scripting.api.sim.constants import SimConstants
from bubblesim.scripting.api.sim.scene_objects import member
from bubblesim.scripting.api.waiting_functions import Waiting
from bubblesim.scripting.language.lua_values import LuaFunction, LuaScriptError, LuaValues
from bubblesim.scripting.language.script_output import Source, print_line
from bubblesim.scripting.language.source import ScriptSourceError, find_file
from bubblesim.scripting.threads.lua_thread import LuaThread

_SANDBOX = Path(__file__).with_name("sandbox.lua")
_SHOWN_VALUES = Path(__file__).with_name("shown_values.lua")
_LIBRARIES = Path(__file__).with_name("libraries.lua")
_OBJECTS = Path(__file__).with_name("objects.lua")
_WAITING = Path(__file__).with_name("waiting.lua")
_ADDED = {"matrix": Path(__file__).with_name("matrix.lua"), "utils": Path(__file__).with_name("utils.lua")}
_VARIABLES = ("HOME", "LANG", "LANGUAGE", "PWD", "ROS_DISTRO", "TMPDIR", "TZ", "USER")
_MOST_BYTES = 64 << 20  # of a file that a script reads
_CALL_TYPE = re.compile(r"\bsim_call_type\b")
_CALLBACK = re.compile(r"\bsysCall_\w+")
_OF_V_REP = re.compile(r"\bsim(?:[A-Z]\w*|\.\w+)\s*\(")
_LIKE_CALLBACK = re.compile(r"\bfunction\s+sys|\bsys\w*\s*=\s*function", re.IGNORECASE)
_EACH_STEP = re.compile(r"\b(?:simHandleChildScript|sim\.handleChildScript|simGetScriptExecutionCount)\s*\(")
_OTHER_CALL_TYPES = {"beforesimulation": 4, "aftersimulation": 5, "suspend": 6, "suspended": 7, "resume": 8}
_PLACE_TIMEOUT = 0.3
_MAX_MEMORY = 1 << 30  # bytes; above, a script fails with "not enough memory"
_MAX_NAME_LENGTH = 50  # of a chunk: Lua truncates names above 59 characters
_PLAIN_NAME = re.compile(r"[\w.+-]+", re.ASCII)


class LuaCode:
    """See ScriptCode."""

    def __init__(
        self,
        file: Path,
        text: str,
        search_paths: list[Path],
        modules: dict[str, Any],
        source: Source,
        *,
        unsafe: bool,
        read: Callable[[Path], str],
    ) -> None:
        """Compile the ``text`` of ``file`` without running it.

        :param modules: the globals ``sim``, ``simROS``, ``simROS2`` of the script.
        :param source: where printed lines come from.
        :param unsafe: keep the libraries ``os``, ``io``, ``debug``, ``package``.
        :param read: reads a file that the script requires.
        :raises ScriptSourceError: if it cannot be read or compiled.
        """
        self._read = read
        self._file = file
        self._text = text
        self._folders = [file.parent, *search_paths]
        self._modules = modules
        self._waiting: dict[int, Waiting] = {}  # functions that take several steps, by number
        self._begun = 0
        self._thread: LuaThread | None = None
        self._noted: set[str] = set()  # calls with too many arguments
        self._files: dict[str, Path] = {}  # by chunk name
        self._source = source
        self._place_requested = False
        self._place = ""
        self._place_reported = threading.Event()
        self._runtime = lua54.LuaRuntime(
            encoding=None,  # strings are bytes
            unpack_returned_tuples=True,
            register_eval=False,
            register_builtins=False,
            attribute_filter=_no_attributes,
            max_memory=_MAX_MEMORY,
        )
        self.is_confined = not unsafe
        self._values = LuaValues(self._runtime, self._place_of, self._note_surplus)
        self._sandbox = self._create_sandbox(modules, unsafe=unsafe)
        self._values.run_in_sandbox = self._sandbox[b"run"]
        self._body, problem = _pair(self._sandbox[b"compile"](_as_lua(text), self._chunk_name(file)))
        if self._body is None:
            raise ScriptSourceError(self._with_whole_paths(problem.decode(errors="backslashreplace")))

    def run(self) -> None:
        """Run the body of the script; that of a script of V-REP 3 becomes its callbacks."""
        text = self._text
        if _CALLBACK.search(text) or _LIKE_CALLBACK.search(text):
            self._values.run(self._body)
        elif _CALL_TYPE.search(text):
            more = {number: True for name, number in _OTHER_CALL_TYPES.items() if name in text}
            self._sandbox[b"make_callbacks"](self._body, self._values.to_lua(more))
        elif _EACH_STEP.search(text):
            self._sandbox[b"make_step"](self._body)
        elif _OF_V_REP.search(text):
            self._sandbox[b"make_old_thread"](self._body)
        else:
            self._values.run(self._body)

    def execute(self, text: str) -> Any:
        """Run code with the script's globals; return the value of an expression."""
        compiled, _ = _pair(self._sandbox[b"compile"](b"return " + text.encode(), b"=string"))
        if compiled is None:
            compiled, problem = _pair(self._sandbox[b"compile"](text.encode(), b"=string"))
            if compiled is None:
                raise ValueError(problem.decode(errors="backslashreplace"))
        return LuaFunction(self._values, compiled, "string")()

    def function(self, name: str) -> Callable[..., Any] | None:
        """Return a global function of the script."""
        value = self._sandbox[b"global"](name.encode())
        return LuaFunction(self._values, value, name) if lua54.lua_type(value) == "function" else None

    def functions_by_name(self) -> dict[str, str]:
        """Return the global functions of the script with FILE:LINE of each."""
        return {
            name.decode(errors="backslashreplace"): self._with_whole_paths(place.decode(errors="backslashreplace"))
            for name, place in self._sandbox[b"functions"]().items()
        }

    def make_thread(self, name: str, body: Callable[..., Any], prepare: Callable[[], object]) -> LuaThread:
        """Create a coroutine that runs ``body``, a function of the script."""
        assert isinstance(body, LuaFunction)
        resume = self._sandbox[b"make_thread"](body.in_lua)
        self._thread = LuaThread(lambda: bool(self._values.run(resume)[0]))
        return self._thread

    def was_interrupted(self, error: BaseException) -> bool:
        """Return whether the script failed because it was interrupted."""
        return isinstance(error, KeyboardInterrupt) or (isinstance(error, LuaScriptError) and error.interrupted)

    def where_now(self, thread: int) -> str:
        """Return FILE:LINE of the script that runs in another thread, or an empty string."""
        self._place_reported.clear()
        self._place_requested = True
        return self._place if self._place_reported.wait(_PLACE_TIMEOUT) else ""

    def _report_place(self, chunk: bytes, line: int) -> None:
        self._place_requested = False
        self._place = self._place_of(chunk, line)
        self._place_reported.set()

    def _place_of(self, chunk: bytes, line: int) -> str:
        return self._with_whole_paths(f"{chunk.decode(errors='replace')}:{line}")

    def place(self, error: BaseException) -> str:
        """Return FILE:LINE where the script failed, or an empty string."""
        match = re.match(r"(.*?):(\d+): ", self._with_whole_paths(_message(error)))
        return f"{match[1]}:{match[2]}" if match else ""

    def report(self, error: BaseException) -> str:
        """Return the error message and the calls, the last one first."""
        text, begins, calls = self._with_whole_paths(_message(error)).partition("\nstack traceback:\n")
        others = ("[C]:", "[sandbox]", "(...tail calls...)", "stack traceback:")
        of_script = [line for line in calls.splitlines() if not any(other in line for other in others)]
        return "\n".join([text + (begins.rstrip() if of_script else ""), *of_script])

    def reason(self, error: BaseException) -> str:
        """Return the error message, in one line."""
        return self.report(error).partition("\n")[0]

    def _create_sandbox(self, modules: dict[str, Any], *, unsafe: bool) -> Any:
        to_lua, callable_from_lua = self._values.to_lua, self._values.callable_from_lua
        host = self._runtime.table()
        found = {name: functions(type(module)) for name, module in modules.items() if module}
        host[b"modules"] = self._runtime.table_from(
            {name.encode(): self._module(modules[name], members) for name, members in found.items()}
        )
        absent = {name: no_ros.reason(name) for name, module in modules.items() if not module}
        host[b"absent"] = to_lua(ABSENT | absent)
        host[b"write"] = callable_from_lua(self._write)
        host[b"find_source"] = callable_from_lua(self._find_source)
        host[b"find_included"] = callable_from_lua(self._find_included)
        host[b"explain"] = callable_from_lua(_explanation)
        modules["sim"].run_waiting = self._begin_waiting
        host[b"waiting"] = self._values.to_lua([f.name for f in found["sim"] if f.waits])
        host[b"go_on"] = callable_from_lua(self._go_on)
        host[b"old_name"] = callable_from_lua(self._old_name)
        host[b"v_rep_name"] = callable_from_lua(self._v_rep_name)
        host[b"read_file"] = callable_from_lua(self._read_file)
        host[b"getenv"] = callable_from_lua(lambda name: os.environ.get(name) if name in _VARIABLES else None)
        host[b"libraries"] = self._function_of(_LIBRARIES)
        host[b"objects"] = self._function_of(_OBJECTS)
        host[b"own"] = caller_of(modules["sim"]).object_handle
        host[b"member"] = callable_from_lua(lambda handle, name: member(modules["sim"], handle, name))
        host[b"wait"] = self._function_of(_WAITING)
        host[b"added"] = self._runtime.table_from(
            {name.encode(): self._function_of(path) for name, path in _ADDED.items()}
        )
        host[b"whole"] = callable_from_lua(lambda text: self._with_whole_paths(_decoded(text)))
        host[b"shown"] = self._runtime.execute(_SHOWN_VALUES.read_bytes(), name=b"=[sandbox]")
        host[b"is_interruption"] = lambda problem: isinstance(problem, KeyboardInterrupt)
        host[b"pulse"] = self._pulse
        host[b"report_place"] = self._report_place
        host[b"unsafe"] = to_lua(unsafe)
        return self._runtime.execute(_SANDBOX.read_bytes(), host, name=b"=[sandbox]")

    def _function_of(self, file: Path) -> Any:
        """Return a file of this package as a function of Lua."""
        return self._runtime.execute(b"return function(...) " + file.read_bytes() + b"\nend", name=b"=[sandbox]")

    def _write(self, line: str | bytes) -> None:
        print_line(self._source, _decoded(line))

    def _begin_waiting(self, waiting: Waiting) -> int:
        """Keep a function that takes several steps; a coroutine lets it go on."""
        self._begun += 1
        self._waiting[self._begun] = waiting
        return self._begun

    def _go_on(self, number: int) -> tuple[Any, ...]:
        """Carry out a step of such a function; return whether it is done, and then its results."""
        try:
            next(self._waiting[number])
        except StopIteration as end:
            del self._waiting[number]
            return (True, *end.value) if isinstance(end.value, tuple) else (True, end.value)
        return (False,)

    def _old_name(self, module: str, name: str) -> str | None:
        """Return the present name of a function of a module, and log it once."""
        present = present_name(module, name)
        if present is None or not _exists(module, present):
            return None
        note_old_name(caller_of(self._modules["sim"]), f"{module}.{name}", f"{module}.{present}")
        return present

    def _v_rep_name(self, name: str) -> tuple[str, str] | None:
        """Return module and name of a global function or constant of V-REP 3, and log it once."""
        found = of_v_rep(name, lambda module, present: module in self._modules and _exists(module, present))
        if found is not None:
            note_old_name(caller_of(self._modules["sim"]), name, ".".join(found))
        return found

    def _read_file(self, name: str | bytes) -> Any:
        """Return the bytes of a file beside the scene or the script; nothing and the reason if it cannot be read, with
        a warning if it is elsewhere, or hidden."""
        scene = Path(self._modules["sim"].getStringParam(SimConstants.stringparam_scene_path))
        folders = [folder.resolve() for folder in (*self._folders, scene) if folder != Path()]
        given = Path(os.fsdecode(name))
        file = next((each for folder in folders if (each := folder / given).is_file()), folders[0] / given).resolve()
        inside = next((file.relative_to(folder) for folder in folders if file.is_relative_to(folder)), None)
        if inside is None or any(part.startswith(".") for part in inside.parts):
            sim = self._modules["sim"]
            why = f"{file} is not beside the scene or the script: --lua-unsafe lets scripts read other files"
            sim.addLog(sim.verbosity_scriptwarnings | sim.verbosity_once, f"io.open: {why}")
            return None, why
        try:
            if file.stat().st_size > _MOST_BYTES:
                raise ValueError(f"io.open: {file} has more than {_MOST_BYTES >> 20} MiB")
            return file.read_bytes()
        except OSError as error:
            return None, f"{given}: {error.strerror}"

    def _turn_is_over(self) -> bool:
        return self._thread is not None and self._thread.turn_is_over()

    def _pulse(self) -> bool:
        """Enter Python, which then handles signals. Return whether the current place is requested."""
        if self._thread is not None:
            self._thread.check_exit()
        return self._place_requested

    def _note_surplus(self, text: str) -> None:
        """Warn once of a call whose last arguments are ignored."""
        if text in self._noted:
            return
        self._noted.add(text)
        caller = caller_of(self._modules["sim"])
        line = f"child script of {caller.object_path}: {text}: the last ones are ignored"
        write_line(sys.stderr, f"warning: {line}")
        caller.shared.log.add(log.SCRIPT_WARNING, caller.object_path, line)

    def _module(self, module: Any, members: list[ScriptFunction]) -> Any:
        names = [member.name for member in members]
        constants = {
            name: getattr(module, name)
            for name in sorted(set(dir(module)).difference(names))
            if not name.startswith("_") and isinstance(getattr(module, name), int | float | str | dict)
        }
        table = self._runtime.table()
        table[b"constants"] = self._values.to_lua(constants)
        table[b"functions"] = self._runtime.table_from(
            {name.encode(): self._values.callable_from_lua(_late(module, name), self._turn_is_over) for name in names}
        )
        return table

    def _find_source(self, name: str) -> tuple[bytes, bytes]:
        """Return text and chunk name of a Lua file required by the script."""
        return self._source_of(find_file(f"{name.replace('.', '/')}.lua", self._folders))

    def _find_included(self, name: str) -> tuple[bytes, bytes]:
        """Return the same of a file that is run beside the scene: not the script itself, which is named after its
        object when it comes from a file of CoppeliaSim."""
        return self._source_of(find_file(f"{name}.lua", self._folders, but_not=self._file))

    def _source_of(self, file: Path) -> tuple[bytes, bytes]:
        return _as_lua(self._read(file)), self._chunk_name(file)

    def _chunk_name(self, file: Path) -> bytes:
        """Return a short unique name for a file, because Lua truncates long ones; see _with_whole_paths."""
        name = file.name
        if len(name) > _MAX_NAME_LENGTH or not _PLAIN_NAME.fullmatch(name) or self._files.get(name, file) != file:
            name = next(each for n in itertools.count(1) if (each := f"file{n}.lua") not in self._files)
        self._files[name] = file
        return b"@" + name.encode()

    def _with_whole_paths(self, text: str) -> str:
        names = "|".join(map(re.escape, self._files))
        return re.sub(rf"(?<![\w/.+-])({names})(?=:\d)", lambda match: str(self._files[match[1]]), text)


def _late(module: Any, name: str) -> Callable[..., Any]:
    """Return a function of a module that is looked up when it is called: its checks are made at its first use."""
    return lambda *arguments: getattr(module, name)(*arguments)


def _exists(module: str, name: str) -> bool:
    return module in MODULES and not name.startswith("_") and name in dir(MODULES[module])


def _explanation(module: str, name: str) -> str:
    """Return the error message for an unknown name; the module is empty for a global."""
    if module:
        return explain(module, name, MODULES)
    return f"there is no function {name} here, neither under a present name; `bubblesim api` lists all functions"


def _as_lua(text: str) -> bytes:
    return (f"--{text}" if text.startswith("#") else text).encode()  # the header


def _pair(results: Any) -> tuple[Any, Any]:
    """Return the one or two results of a Lua function as a pair."""
    return results if isinstance(results, tuple) else (results, None)


def _decoded(text: str | bytes) -> str:
    return text.decode(errors="backslashreplace") if isinstance(text, bytes) else text


def _message(error: BaseException) -> str:
    text = str(error)
    if isinstance(error, lua54.LuaMemoryError) or text.startswith("not enough memory"):
        return f"not enough memory: a Lua script is limited to {_MAX_MEMORY >> 20} MB"
    return text or type(error).__name__


def _no_attributes(_object: Any, name: Any, _setting: bool) -> Any:
    raise AttributeError(f"Lua scripts cannot access attributes of Python objects: {name!r}")
