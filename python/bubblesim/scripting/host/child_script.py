# SPDX-License-Identifier: BSD-3-Clause
"""One child script: its globals, callbacks and error handling."""

from __future__ import annotations

import difflib
import sys
from collections.abc import Callable, Hashable
from pathlib import Path
from typing import Any

from bubblesim import _core
from bubblesim.messages.names import did_you_mean
from bubblesim.program.output import write_line
from bubblesim.scene_state import log, problems
from bubblesim.scene_state.object_tree import acting_object
from bubblesim.scene_state.problems import Problem
from bubblesim.scripting.allowed_programs import is_allowed
from bubblesim.scripting.caller import Hook
from bubblesim.scripting.host import interruption, process_calls, sensor_callbacks
from bubblesim.scripting.host.callback_names import HOOKS, OLD_NAMES, PAUSE_HOOKS, looks_like_callback, never_called
from bubblesim.scripting.host.file_stamps import FileStamps
from bubblesim.scripting.host.protocols import Host
from bubblesim.scripting.host.started_programs import Program, end_programs
from bubblesim.scripting.language import script_output
from bubblesim.scripting.language.python_code import PythonCode
from bubblesim.scripting.language.script_code import ScriptCode, load_code
from bubblesim.scripting.language.script_output import Source
from bubblesim.scripting.language.source import ScriptSourceError, read_text
from bubblesim.scripting.threads import script_sockets
from bubblesim.scripting.threads.script_thread import AnyThread


class ChildScript:
    """A script attached to an object. After an error, the script is reported once and disabled."""

    def __init__(self, host: Host, object_path: str, object_handle: int, file: Path) -> None:
        """Load ``file`` without calling any callback."""
        self.host = host
        self.object_path = object_path
        self.object_handle = object_handle
        self.file = file
        self.is_remote = False
        self.alive = True
        self.failed = False
        self.failure = ""  # the first line of its error
        self.follows_pauses = False
        self._is_of_sensor = False
        self.running = False  # its code is on the call stack
        self.activity = "loading"  # the callback or action that runs
        self.stuck_at = ""  # FILE:LINE where the watchdog found it
        self.shared = host.shared
        self.stepping = 0  # for the thread that starts after sysCall_init
        self.uses_old_names = False
        self.programs: list[Program] = []  # started by the script
        self.at_end: dict[Hashable, Hook] = {}  # release the script's other resources, such as publishers
        self.in_each_step: dict[Hashable, Hook] = {}  # updates of such resources; must not raise
        self._started = False
        self._thread: AnyThread | None = None
        self._sockets = script_sockets.Sockets()
        self._module_name = f"child_script_{object_path.strip('/').replace('/', '_')}"
        self._hooks: dict[str, Callable[..., Any] | None] = dict.fromkeys(HOOKS)
        try:
            self._load()
        except BaseException:  # not the script's: nothing else would end it
            self.finish()
            raise

    def _load(self) -> None:
        self._stamps = FileStamps()
        try:
            self._code: ScriptCode = load_code(
                self.file,
                self.host.search_paths,
                self.host.make_modules(self),
                self._module_name,
                Source(self.object_path, lambda: float(self.host.simulation.time), self.shared.log.add_written),
                lua_unsafe=self.host.lua_unsafe,
                read=self._read,
            )
        except ScriptSourceError as error:
            problem = problems.of_source(self.object_path, str(self.file), str(error))
            self._fail(f"error: child script of {self.object_path} is disabled: {error}", problem)
            return
        if not self.run("loading", self._code.run):
            return
        self._hooks = {name: self._code.function(name) for name in HOOKS}
        for name, old in OLD_NAMES.items():
            self._hooks[name] = self._hooks[name] or self._code.function(old)
        self.follows_pauses = any(self._hooks[name] is not None for name in PAUSE_HOOKS)
        self._is_of_sensor = any(self._hooks[name] is not None for name in ("sysCall_vision", "sysCall_trigger"))
        self._warn_of_unknown_callbacks()
        optional = ("sysCall_actuation", "sysCall_sensing", "sysCall_reset", "sysCall_cleanup", *PAUSE_HOOKS)
        if not any(self._hooks[name] for name in HOOKS if name not in optional):
            why = "it defines neither sysCall_init nor sysCall_thread; a script needs one of these functions"
            self._fail(
                f"error: child script of {self.object_path} is disabled: {self.file}: {why}",
                self._problem("error", why),
            )

    def _read(self, file: Path) -> str:
        self._stamps.note(file)
        return read_text(file)

    def _warn_of_unknown_callbacks(self) -> None:
        for name, place in sorted(self._code.functions_by_name().items()):
            if looks_like_callback(name) and name not in (*HOOKS, *OLD_NAMES.values()):
                self._log(
                    f"warning: child script of {self.object_path}: {place or self.file}: {never_called(name)}",
                    log.SCRIPT_WARNING,
                )
                self.host.add_problem(self._problem("warning", never_called(name), place))

    def _problem(self, level: str, text: str, place: str = "") -> Problem:
        return problems.of_script(level, self.object_path, str(self.file), place, text)

    def _log(self, text: str, level: int) -> None:
        write_line(sys.stderr, text)
        self.shared.log.add(level, self.object_path, text.partition(": ")[2])

    @property
    def in_lua(self) -> bool:
        """Whether it is a script in Lua."""
        return not isinstance(self._code, PythonCode)

    @property
    def may_use_files(self) -> bool:
        """Whether the script may read and write all files; false for Lua scripts, unless --lua-unsafe is given."""
        return not self._code.is_confined

    def may_start(self, program: Path) -> bool:
        """Return whether the script may start a program; restricted for Lua scripts."""
        return not self._code.is_confined or is_allowed(program, self.host.allowed_programs)

    def actuate(self) -> None:
        """Run sysCall_actuation, and before the first time sysCall_init."""
        if not self._started:
            self.begin()
        if self.in_each_step:
            for hook in list(self.in_each_step.values()):
                hook()
        if self._thread and self.alive and not interruption.requested:
            self.run("sysCall_thread", self._thread.run_turn)
        self._call("sysCall_actuation")

    def begin(self) -> None:
        """Run sysCall_init, and begin the thread."""
        self._started = True
        self._call("sysCall_init")
        self._start_thread()

    def has_hook(self, name: str) -> bool:
        """Return whether it defines a callback and may be called."""
        return self.alive and self._hooks[name] is not None

    def answer(self, hook: str, *data: Any) -> Any:
        """Run a callback with data and return its result; None without one, and if it fails."""
        function = self._hooks[hook]
        results: list[Any] = []
        if function is not None and self._started and self.alive and not interruption.requested:
            self.run(hook, lambda: results.append(function(*data)))
        return results[0] if results else None

    def _start_thread(self) -> None:
        body = self._hooks["sysCall_thread"]
        if body is not None and self.alive:
            name = f"{self.object_path} sysCall_thread"
            self._thread = self._code.make_thread(name, body, lambda: script_sockets.record_in(self._sockets))
            self._thread.stepping = self.stepping

    def _end_thread(self) -> None:
        thread, self._thread = self._thread, None
        if thread and not thread.end(lambda: script_sockets.shut_down(self._sockets)):
            self._log(f"warning: the thread of the child script of {self.object_path} does not end", log.SCRIPT_WARNING)

    def sense(self) -> None:
        """Run sysCall_vision and sysCall_trigger of a sensor's script, and sysCall_sensing."""
        if self._is_of_sensor:
            self._sense_with_sensor()
        self._call("sysCall_sensing")

    def _sense_with_sensor(self) -> None:
        simulation = self.host.simulation
        handle = acting_object(simulation.world, self.object_handle)
        if self._hooks["sysCall_vision"] is not None and (data := sensor_callbacks.image_data(simulation, handle)):
            sensor_callbacks.keep_vision_result(self.shared, handle, self.answer("sysCall_vision", data))
        if self._hooks["sysCall_trigger"] is not None:
            event = sensor_callbacks.trigger_data(simulation, handle, self.shared)
            if event is not None:
                sensor_callbacks.keep_trigger_result(self.shared, handle, self.answer("sysCall_trigger", event))

    def call_hook(self, hook: str) -> None:
        """Run a callback without data of a script that has begun."""
        if self._started:
            self._call(hook)

    def clean_up(self) -> None:
        """End the thread and run sysCall_cleanup."""
        self._end_thread()
        if self._started:
            self._call("sysCall_cleanup")

    def finish(self) -> None:
        """Release the script's resources; call it after clean_up."""
        self._end()
        sys.modules.pop(self._module_name, None)
        script_output.sources.pop(self._module_name, None)

    def was_edited(self) -> bool:
        """Return whether one of its source files has changed."""
        return self._stamps.differ()

    def where_now(self, thread: int) -> str:
        """Return FILE:LINE of the code that the simulation waits for, or an empty string.

        :param thread: the simulation's thread.
        """
        if self._thread and self._thread.ident and self.activity == "sysCall_thread":
            thread = self._thread.ident
        return self._code.where_now(thread)

    def _call(self, name: str) -> None:
        hook = self._hooks[name]
        if hook is not None and self.alive and (name == "sysCall_cleanup" or not interruption.requested):
            self.run(name, hook)

    def run(self, what: str, action: Hook) -> bool:
        """Run a part of the script; on failure, report and end the script. Return whether it succeeded."""
        try:
            host = self.host
            outer = interruption.allowed, self.running, self.activity, host.running_script
            sockets = script_sockets.record_in(self._sockets)
            try:
                interruption.allowed = self.running = True
                self.activity = what
                host.running_script = self
                host.calls += 1
                action()
            finally:
                process_calls.end_if_forked()
                interruption.allowed, self.running, self.activity, host.running_script = outer
                script_sockets.record_in(sockets)
        except SystemExit:
            self._end()
        except BaseException as error:
            self._report(error, what)
        else:
            return True
        return False

    def _report(self, error: BaseException, what: str) -> None:
        """Report why ``what`` failed, and end the script unless the simulator ends."""
        for_stop, interruption.for_stop = interruption.for_stop, False
        was_interrupted = (for_stop or interruption.requested) and self._code.was_interrupted(error)
        place = (self.stuck_at if was_interrupted and for_stop else "") or self._code.place(error)
        where = f"{what} ({place})" if place else what
        self.failure = self._code.reason(error)
        if not was_interrupted:
            report = self._code.report(error)
            self._fail(
                f"error: child script of {self.object_path} failed in {where} and is disabled:\n{report}",
                self._problem("error", self.failure, place),
            )
        elif interruption.requested:
            write_line(
                sys.stderr,
                f"warning: child script of {self.object_path} was interrupted in {where}: the simulator is ending",
            )
        else:
            why = "it did not return while a stop or a reset was pending"
            self._fail(
                f"error: child script of {self.object_path} was interrupted in {where} and is disabled: {why}",
                self._problem("error", why, place),
            )

    def functions(self) -> list[str]:
        """Return the names of its global functions."""
        return sorted(name for name in self._code.functions_by_name() if callable(self._code.function(name)))

    def call_function(self, name: str, arguments: tuple[Any, ...]) -> Any:
        """Call a global function for another caller, which gets its errors as a RuntimeError."""
        self._check_alive()
        target = self._code.function(name)
        if not callable(target):
            near = did_you_mean(difflib.get_close_matches(name, self.functions(), n=2))
            raise RuntimeError(f"the child script of {self.object_path} has no function '{name}'{near}")
        return self._answer_to_other(name, f"the function {name}", lambda: target(*arguments))

    def execute(self, text: str) -> Any:
        """Run code with its globals for another caller, which gets its errors as a RuntimeError."""
        self._check_alive()
        return self._answer_to_other("the code", "code from a string", lambda: self._code.execute(text))

    def _check_alive(self) -> None:
        if not self.alive:
            raise RuntimeError(f"the child script of {self.object_path} has failed or ended: it cannot be called")

    def _answer_to_other(self, name: str, what: str, action: Callable[[], Any]) -> Any:
        results: list[Any] = []
        errors: list[Exception] = []

        def call() -> None:
            try:
                results.append(action())
            except Exception as error:  # the caller's problem: the script goes on
                errors.append(error)

        self.run(what, call)
        if results:
            return results[0]
        why = self._code.reason(errors[0]) if errors else "it was interrupted"
        raise RuntimeError(f"{name} of the child script of {self.object_path}: {why}")

    def callback(self, function: Callable[..., object] | str) -> Callable[..., None]:
        """Return a callback that ends the script on failure. ``function`` may be the name of a global of the script."""
        target, what = self._target(function)

        def guarded(*arguments: Any) -> None:
            if self.alive:
                self.run(what, lambda: target(*arguments))

        return guarded

    def answering_callback(
        self, function: Callable[..., Any] | str, check: Callable[[object], None]
    ) -> Callable[..., Any]:
        """Return a callback with a result; it raises ServiceError if it fails or ``check`` rejects the result."""
        target, what = self._target(function)

        def guarded(*arguments: Any) -> Any:
            results: list[Any] = []

            def answer() -> None:
                result = target(*arguments)
                check(result)
                results.append(result)

            if not self.alive or not self.run(what, answer):
                why = f"{self.failure}; " if self.failure else ""
                raise _core.ServiceError(f"{why}the child script of {self.object_path} failed or ended")
            return results[0]

        return guarded

    def _target(self, function: Callable[..., Any] | str) -> tuple[Callable[..., Any], str]:
        """Return the function, and its description for messages."""
        target = self._code.function(function) if isinstance(function, str) else function
        if callable(target):
            return target, f"the callback {getattr(target, '__name__', function)}"
        if isinstance(function, str):
            raise ValueError(f"the callback '{function}' is not a function of the script")
        raise TypeError(f"a callback must be a function or the name of a function, found {type(function).__name__}")

    def _fail(self, text: str, problem: Problem) -> None:
        self._log(text, log.SCRIPT_ERROR)
        self.host.add_problem(problem)
        self.host.failures += 1
        self.failed = True
        self.host.count_disabled()
        self._end()

    def _end(self) -> None:
        self.alive = False
        self._end_thread()
        end_programs(self.programs)
        self.programs = []
        while self.at_end:
            _, undo = self.at_end.popitem()  # in reverse order
            try:
                undo()
            except Exception as error:  # an error must not prevent releasing the others
                self._log(f"warning: child script of {self.object_path}: while it ended: {error}", log.SCRIPT_WARNING)
