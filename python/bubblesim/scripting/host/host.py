# SPDX-License-Identifier: BSD-3-Clause
"""Keeps the child scripts of a scene and calls them in each step."""

from __future__ import annotations

import gc
import math
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from bubblesim import _core
from bubblesim._core.messages import RosVersion
from bubblesim.both_bridges import bridge_of
from bubblesim.program.output import write_line
from bubblesim.scene_state.log import Log
from bubblesim.scene_state.object_tree import is_script_object
from bubblesim.scene_state.problems import Problem
from bubblesim.scene_state.shared_data import SharedData
from bubblesim.scripting.api.ik.ik_module import SimIk
from bubblesim.scripting.api.image.image_module import SimIm
from bubblesim.scripting.api.ompl.ompl_module import SimOmpl
from bubblesim.scripting.api.ros.no_ros import NoRos
from bubblesim.scripting.api.ros.ros_modules import SimRos, SimRos2
from bubblesim.scripting.api.sim.remote_api_module import SimRemoteApi
from bubblesim.scripting.api.sim.sim_module import SimApi
from bubblesim.scripting.api.ui.ui_module import SimUi
from bubblesim.scripting.api.vision.vision_module import SimVision
from bubblesim.scripting.caller import Caller
from bubblesim.scripting.host import interruption, process_calls
from bubblesim.scripting.host.child_script import ChildScript
from bubblesim.scripting.host.known_problems import KnownProblems
from bubblesim.scripting.host.script_descriptions import described
from bubblesim.scripting.host.started_programs import end_programs
from bubblesim.scripting.host.substep_callbacks import SubstepCallbacks
from bubblesim.scripting.host.watchdog import Watchdog
from bubblesim.scripting.language import script_output
from bubblesim.scripting.language.source import read_text
from bubblesim.scripting.threads import script_sockets, script_thread

_CHECK_INTERVAL = 0.25  # s


class ScriptHost:
    """Created by the simulator's node, which calls ``actuate`` and ``sense`` in each step and ``finish`` at the end."""

    def __init__(
        self,
        runner: Any,
        bridge: Any | None,
        scripts: list[tuple[str, Path]],
        search_paths: list[Path],
        *,
        lua_unsafe: bool = False,
        allowed_programs: Sequence[str] = (),
        watch: bool = False,
    ) -> None:
        """Store the scripts; ``start`` loads them.

        :param runner: the ``bubblesim.Runner`` of the simulation.
        :param bridge: a ``bubblesim._core.Bridge``, a BothBridges, or None: then ``simROS`` is a ``NoRos`` in scripts.
        :param scripts: pairs of object path and file.
        :param search_paths: folders for ``include``, searched after the script's folder.
        :param lua_unsafe: give Lua scripts access to files and processes.
        :param allowed_programs: programs, and folders of programs, that Lua scripts may start in addition to those of
            ROS packages.
        :param watch: reload a script when its file changes.
        """
        self.runner = runner
        self.simulation = runner.simulation
        self.bridge = bridge
        self.search_paths = search_paths
        self.lua_unsafe = lua_unsafe
        self.allowed_programs = [str(each) for each in allowed_programs]
        self.failures = 0
        self.disabled = 0  # number of loaded scripts that have failed
        self.calls = 0  # number of calls of scripts
        self.running_script: ChildScript | None = None
        self.stops_elsewhere: list[Callable[[], bool]] = []
        """Return whether a stop waits that neither the bridge nor the runner knows; called in the watchdog's thread."""
        self.shared = SharedData(has_ros=bridge is not None, scripts=self, log=Log(lambda: float(self.simulation.time)))
        self._substeps = SubstepCallbacks(runner, self.shared.edits)
        self._substeps_stale = False  # scripts were loaded, removed or disabled
        self._texts: TemporaryDirectory[str] | None = None  # with the files of added scripts
        self._begun = False  # sysCall_beforeSimulation was called in this run
        self.shared.edits.stopped = lambda: bool(runner.state == _core.RunState.STOPPED)
        self._problems = KnownProblems(self.simulation.scene.warnings)
        self._placed = [(path, self.simulation.object(path).handle, Path(file)) for path, file in scripts]
        self._placed.sort(key=lambda script: _turn(script[0], script[1]))
        self.scripts: list[ChildScript] = []
        self._following_pauses: list[ChildScript] = []
        self._paused = False  # the state last reported to scripts
        self._next_check = 0.0 if watch else math.inf  # time of the next check of the files, by time.monotonic()
        script_sockets.install()
        script_thread.install()
        script_output.install()
        process_calls.install()
        self._watchdog: Watchdog | None = None  # from start() to finish()

    def start(self) -> None:
        """Load the scripts from their files; for the simulation's thread."""
        self._watchdog = Watchdog(self)
        try:
            self._begun = False
            contains = self.simulation.world.contains  # objects of added scripts may have ended with the last run
            self._placed = [script for script in self._placed if contains(script[1])]
            self.shared.graphs.begin_run()
            for path, handle, file in self._placed:
                self.scripts += [self._load(path, handle, file)]
            self.count_disabled()
        except BaseException:
            self.stop()
            raise

    def _load(self, path: str, handle: int, file: Path) -> ChildScript:
        self._problems.forget(path)
        return ChildScript(self, path, handle, file)

    def _keep(self, scripts: list[ChildScript]) -> None:
        self.scripts = scripts
        self.count_disabled()

    def count_disabled(self) -> None:
        """Update what each step reads, such as ``disabled``, after a script was loaded, removed or disabled."""
        self.disabled = sum(script.failed for script in self.scripts)
        self._following_pauses = [script for script in self.scripts if script.follows_pauses]
        self._substeps_stale = True

    def stop(self) -> None:
        """End and remove the scripts, with all remaining data: signals, open files and sockets."""
        self.finish()
        self._keep([])
        self.shared.clear(self.simulation.world)
        gc.collect()  # a script's globals and functions refer to each other

    def add_script(self, path: str, file: Path) -> None:
        """Register the script of an added model, and load it unless the simulation is stopped."""
        self._place(path, self.simulation.object(path).handle, Path(file))

    def _place(self, path: str, handle: int, file: Path) -> None:
        self._placed.append((path, handle, file))
        self._placed.sort(key=lambda script: _turn(script[0], script[1]))
        if self.runner.state == _core.RunState.STOPPED:
            return
        loaded = [*self.scripts, self._load(path, handle, file)]
        self._keep(sorted(loaded, key=lambda script: _turn(script.object_path, script.object_handle)))

    def add_text(self, handle: int, text: str, suffix: str) -> None:
        """Attach a script to an object, from its text in a file of its own; raise ValueError if it has one."""
        if self.has_script(handle):
            raise ValueError(f"{self.simulation.world.short_path(handle)} has a script")
        if self._texts is None:
            self._texts = TemporaryDirectory(prefix="bubblesim_scripts_")
        file = Path(self._texts.name) / f"script_{handle}.{suffix}"
        file.write_text(text, encoding="utf-8")
        self._place(self.simulation.world.path(handle), handle, file)

    def model_removing(self, model: int) -> None:
        """Call sysCall_cleanup of the scripts of a model that is about to be removed, and remove them."""
        ending = self._scripts_of(model)
        _finish(ending)
        tree = self.simulation.world
        gone = {model, *(int(o.handle) for o in self.simulation.objects if tree.outermost_model_of(o.handle) == model)}
        self.shared.dummies.remove_below(tree, gone)
        self.shared.drawings.remove_below(gone)
        self.shared.graphs.remove(gone)
        self.shared.edits.remove(gone)
        for key in [key for key in self.shared.custom_data if key[0] in gone]:
            del self.shared.custom_data[key]
        for script in ending:
            self._problems.forget(script.object_path)
        self._keep([script for script in self.scripts if script not in ending])
        model_of = self.simulation.world.outermost_model_of
        self._placed = [script for script in self._placed if model_of(script[1]) != model]

    def remove_model(self, model: int) -> None:
        """Remove a model and its scripts from the world; raise RuntimeError if called from one of these scripts."""
        if any(script.running for script in self._scripts_of(model)):
            raise RuntimeError("a child script cannot remove its own model")
        self.simulation.remove_model(model)

    def has_script(self, handle: int) -> bool:
        """Return whether a script is attached to an object, or to a script object below it."""
        return self._holder(handle) is not None

    def _holder(self, handle: int) -> int | None:
        """Return the object that has an object's script: itself, or a script object below it."""
        placed = {each for _, each, _ in self._placed}
        if handle in placed:
            return handle
        world = self.simulation.world
        below = world.children(handle) if handle >= 0 else []
        return next((each for each in below if each in placed and is_script_object(world, each)), None)

    def script_functions(self, handle: int) -> list[str]:
        """Return the names of the global functions of an object's script."""
        return self._script_at(handle).functions()

    def call_script(self, handle: int, function: str, arguments: tuple[Any, ...]) -> Any:
        """Call a global function of an object's script; raise RuntimeError if that fails."""
        return self._script_at(handle).call_function(function, arguments)

    def execute(self, handle: int, text: str) -> Any:
        """Run code with the globals of an object's script, and return its value; raise RuntimeError if that fails."""
        return self._script_at(handle).execute(text)

    def is_confined(self, handle: int) -> bool:
        """Return whether an object's script has no access to files and programs."""
        return not self._script_at(handle).may_use_files

    def broadcast(self, message: Any, origin: int) -> None:
        """Call sysCall_msg of all scripts with a message and the object of its sender, -1 for a program."""
        for script in list(self.scripts):
            script.answer("sysCall_msg", message, origin)

    def descriptions(self) -> list[dict[str, Any]]:
        """Return the result of sim.getScripts."""
        loaded = {script.object_handle: script for script in self.scripts}
        return [described(path, handle, file, loaded.get(handle)) for path, handle, file in self._placed]

    def text_of(self, handle: int) -> str:
        """Return the text of the file of an object's script."""
        holder = self._holder(handle)
        for _, placed, file in self._placed:
            if placed == holder:
                return read_text(file)
        raise RuntimeError(f"{self.simulation.world.short_path(handle)} has no child script")

    def restart_script(self, handle: int) -> bool:
        """Load an object's script again from its file; return whether it runs. Call it between steps."""
        if self.runner.state == _core.RunState.STOPPED and self.has_script(handle):
            return False
        write_line(sys.stderr, f"info: restarting the child script of {self._script_at(handle).object_path}")
        return self._reload(self.scripts.index(self._script_at(handle))).alive

    def problems(self) -> dict[str, Any]:
        """Return the result of sim.getProblems."""
        return self._problems.described()

    def add_problem(self, problem: Problem) -> None:
        """Keep a problem of a script until it is loaded again."""
        self._problems.add(problem)

    def _script_at(self, handle: int) -> ChildScript:
        holder = self._holder(handle)
        for script in self.scripts:
            if script.object_handle == holder:
                return script
        if self.has_script(handle):
            raise RuntimeError("the simulation is stopped: its scripts can be called when it has been started")
        raise RuntimeError(f"{self.simulation.world.short_path(handle)} has no child script")

    def _scripts_of(self, model: int) -> list[ChildScript]:
        model_of = self.simulation.world.outermost_model_of
        return [script for script in self.scripts if model_of(script.object_handle) == model]

    def make_modules(self, script: Caller) -> dict[str, Any]:
        """Return the modules in a script's globals."""
        modules: dict[str, Any] = {
            "sim": SimApi(self.runner, script),
            "simUI": SimUi(script),
            "simIK": SimIk(self.runner, script),
            "simOMPL": SimOmpl(self.runner, script),
            "simVision": SimVision(self.runner, script),
            "simIM": SimIm(self.runner, script),
            "simRemoteApi": SimRemoteApi(script),
        }
        if self.bridge is None:
            return {**modules, "simROS": NoRos("simROS"), "simROS2": NoRos("simROS2")}
        return {
            **modules,
            "simROS": SimRos(bridge_of(self.bridge, RosVersion.ROS1), self.simulation, script),
            "simROS2": SimRos2(bridge_of(self.bridge, RosVersion.ROS2), self.simulation, script),
        }

    def process_input(self) -> None:
        """Call the pause callbacks of scripts when the state has changed; called also while paused."""
        if self._following_pauses:
            paused = bool(self.runner.state == _core.RunState.PAUSED)
            if paused:
                hook = "sysCall_suspended" if self._paused else "sysCall_suspend"
            else:
                hook = "sysCall_resume" if self._paused else ""
            self._paused = paused
            for script in self._following_pauses if hook else ():
                script.call_hook(hook)

    def actuate(self) -> None:
        """Call sysCall_actuation of all scripts."""
        if self._next_check < math.inf:
            self._reload_edited()
        if not self._begun:
            self._begin()
        for script in self.scripts:
            script.actuate()
        if self._substeps_stale:
            self._substeps_stale = False
            self._substeps.prepare(self.scripts)
        self._substeps.begin_step()
        if self.shared.edits.holds:
            self.shared.edits.apply(self.simulation.world, self.simulation.time_step)

    def _begin(self) -> None:
        """Call sysCall_init of scripts with sysCall_beforeSimulation, and then that, before all others."""
        self._begun = True
        for script in [script for script in self.scripts if script.has_hook("sysCall_beforeSimulation")]:
            script.begin()
            script.call_hook("sysCall_beforeSimulation")

    def _reload_edited(self) -> None:
        now = time.monotonic()
        if now < self._next_check:
            return
        self._next_check = now + _CHECK_INTERVAL
        for number, script in enumerate(self.scripts):
            if script.was_edited():
                write_line(sys.stderr, f"info: the child script of {script.object_path} has changed: restarting it")
                self._reload(number)

    def _reload(self, number: int) -> ChildScript:
        """End a script of ``scripts`` and load it again from its file."""
        old = self.scripts[number]
        _finish([old])
        self.scripts[number] = self._load(old.object_path, old.object_handle, old.file)
        self.count_disabled()
        return self.scripts[number]

    def sense(self) -> None:
        """Call sysCall_sensing of all scripts, and then record graphs."""
        self._substeps.end_step()
        if self.shared.edits.holds:
            self.shared.edits.apply(self.simulation.world)
        for script in self.scripts:
            script.sense()
        if self.shared.graphs.by_handle:
            self.shared.graphs.record(float(self.simulation.state_time))

    def reset(self) -> None:
        """Call sysCall_reset of all scripts, after the world was reset."""
        self.shared.edits.restore(self.simulation.world)
        for script in self.scripts:
            script.call_hook("sysCall_reset")

    def restart(self) -> None:
        """End all scripts, reset the world to time 0, and reload the scripts unless the simulation is stopped.

        Call it between steps or during input processing; raises RuntimeError if called from a script.
        """
        if interruption.allowed:  # a script is running
            raise RuntimeError("a child script cannot restart the simulation that runs it")
        self.stop()
        self.simulation.reset()
        if self.runner.state != _core.RunState.STOPPED:
            self.start()

    def stop_waits(self) -> bool:
        """Return whether a stop or a reset waits for the running script; thread-safe."""
        if self.bridge is not None and self.bridge.urgent_waits():
            return True
        if any(waits() for waits in self.stops_elsewhere):
            return True
        script = self.running_script  # sysCall_cleanup is part of a stop, and is not interrupted
        return script is not None and script.activity != "sysCall_cleanup" and bool(self.runner.stop_is_due)

    def finish(self) -> None:
        """Call sysCall_cleanup of all scripts and release their resources."""
        try:
            self._substeps.prepare([])
            _finish(self.scripts)
        finally:
            if self._watchdog is not None:
                self._watchdog.end()
                self._watchdog = None


def _finish(scripts: list[ChildScript]) -> None:
    """End scripts; those with sysCall_afterSimulation after the others."""
    last = [script for script in scripts if script.has_hook("sysCall_afterSimulation")]
    for script in scripts:
        if script not in last:
            script.clean_up()
    for script in last:
        script.call_hook("sysCall_afterSimulation")
        script.clean_up()
    end_programs([program for script in scripts for program in script.programs])  # together, because each may take long
    for script in scripts:
        script.finish()


def _turn(path: str, handle: int) -> tuple[int, int]:
    """Return the sort key of the calling order: descendants before ancestors, siblings in the scene's order."""
    return (-path.count("/"), handle)
