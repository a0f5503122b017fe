# SPDX-License-Identifier: BSD-3-Clause
"""What a sweep runs: a Python file with a function `run`, or a scene for a time."""

from __future__ import annotations

import difflib
import functools
import hashlib
import math
import sys
import traceback
import types
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import bubblesim
from bubblesim.messages.names import did_you_mean
from bubblesim.sweeps.tasks import Outcome, Result, SweepError, Task, Value

_MODULE = "bubblesim_sweep_program"  # name of the module of a Python file


class Run:
    """One run, as the function `run` of a Python file gets it."""

    def __init__(self, task: Task) -> None:
        """Take seed and parameters."""
        self.seed = task.seed
        self.parameters: dict[str, Value] = dict(task.parameters)

    def simulation(self, scene: str | bubblesim.Scene) -> bubblesim.Simulation:
        """Return a new simulation of a scene with the seed of the run, and with its parameters `/PATH.PROPERTY` set.

        A scene that is given by its name or path is loaded once in each process.
        """
        simulation = bubblesim.Simulation(_scene(scene) if isinstance(scene, str) else scene, seed=self.seed)
        for name, value in self.parameters.items():
            if name.startswith("/"):
                path, property_name = split_name(name)
                _require_settable(name, property_name)
                setattr(simulation.object(path), property_name, value)
        return simulation


class Program(Protocol):
    """What a sweep runs; it is sent to the processes that run it."""

    @property
    def name(self) -> str:
        """Return a short name."""

    @property
    def digest(self) -> str:
        """Return a hash of all that the results depend on, apart from seed and parameters."""

    @property
    def depends_on(self) -> str:
        """Return what the digest is of, for messages."""

    def load(self) -> Callable[[Run], Mapping[str, Any]]:
        """Return the function of a run. Raise SweepError if there is none."""

    def check(self, names: Sequence[str]) -> None:
        """Check the names of parameters, as far as that is possible before a run. Raise SweepError."""


@dataclass(frozen=True)
class FileProgram:
    """A Python file; it defines `run(run: Run)`, which returns a dict of numbers and strings."""

    file: str  # absolute path
    text: str

    @classmethod
    def read(cls, file: Path) -> FileProgram:
        """Read a file."""
        try:
            return cls(str(file.resolve()), file.read_text(encoding="utf-8"))
        except (OSError, UnicodeDecodeError) as error:
            raise SweepError(f"cannot read {file}: {error}") from error

    @property
    def name(self) -> str:
        """Return the file's name without its suffix."""
        return Path(self.file).stem

    @property
    def digest(self) -> str:
        """Return a hash of the text: modules that it imports are not part of it."""
        return hashlib.sha256(self.text.encode()).hexdigest()

    @property
    def depends_on(self) -> str:
        """Return what the digest is of."""
        return f"the text of {self.file}"

    def check(self, names: Sequence[str]) -> None:
        """Check the properties; the file decides which objects there are."""
        for name in names:
            if name.startswith("/"):
                _require_settable(name, split_name(name)[1])

    def load(self) -> Callable[[Run], Mapping[str, Any]]:
        """Execute the file; modules beside it can be imported."""
        folder = str(Path(self.file).parent)
        if folder not in sys.path:
            sys.path.insert(0, folder)
        module = types.ModuleType(_MODULE)
        module.__file__ = self.file
        sys.modules[_MODULE] = module
        try:
            exec(compile(self.text, self.file, "exec"), module.__dict__)
        except Exception as error:
            raise SweepError(f"{self.file} cannot be loaded:\n{_traceback_in(self.file, error)}") from error
        function = getattr(module, "run", None)
        if not callable(function):
            raise SweepError(f"{self.file} must define a function run(run) that returns a dict of results")
        return function  # type: ignore[no-any-return]


@dataclass(frozen=True)
class SceneProgram:
    """A scene without scripts, simulated for a time; the results are properties of its objects at the end."""

    scene: str  # name or path
    duration: float  # s
    measured: tuple[str, ...] = ()  # /PATH.PROPERTY; none: the position of each model that can move

    @property
    def name(self) -> str:
        """Return the scene's name."""
        return Path(self.scene).stem

    @property
    def digest(self) -> str:
        """Return a hash of the scene's file, the duration and the names: included models are not part of it."""
        text = _scene(self.scene).file.read_bytes()
        return hashlib.sha256(text + repr((self.duration, self.measured)).encode()).hexdigest()

    @property
    def depends_on(self) -> str:
        """Return what the digest is of."""
        return f"the file of the scene {self.scene}, --duration and --measure"

    def check(self, names: Sequence[str]) -> None:
        """Check objects and properties."""
        simulation = bubblesim.Simulation(_scene(self.scene)) if names else None
        for name in names:
            path, property_name = split_name(name)
            _require_settable(name, property_name)
            try:
                if simulation is not None:
                    simulation.object(path)
            except LookupError as error:
                raise SweepError(f"{name}: {error}") from error

    def load(self) -> Callable[[Run], Mapping[str, Any]]:
        """Load the scene and check the names."""
        simulation = bubblesim.Simulation(_scene(self.scene))
        models = [
            obj.path
            for obj in simulation.objects
            if obj.kind == "model" and obj.parent is None and not simulation.world.is_static(obj.handle)
        ]
        measured = self.measured or tuple(f"{path}.position" for path in models)
        for name in measured:
            _measure(simulation, name)
        steps = math.ceil(self.duration / simulation.time_step - 1e-9)

        def run(run: Run) -> dict[str, Any]:
            simulation = run.simulation(self.scene)
            simulation.step(steps)
            return {key: value for name in measured for key, value in _measure(simulation, name).items()}

        return run


def execute(function: Callable[[Run], Mapping[str, Any]], program: Program, task: Task) -> Outcome:
    """Carry out one run."""
    try:
        returned = function(Run(task))
        return Outcome(_checked(returned, task))
    except Exception as error:
        place = program.file if isinstance(program, FileProgram) else ""
        return Outcome(error=_traceback_in(place, error))


def split_name(name: str) -> tuple[str, str]:
    """Split /PATH.PROPERTY."""
    path, dot, property_name = name.rpartition(".")
    if not (path.startswith("/") and dot and property_name.isidentifier()):
        raise SweepError(f"{name!r} must be the path of an object and one of its properties: /Tricycle.position")
    return path, property_name


@functools.lru_cache(maxsize=64)
def _scene(scene: str) -> bubblesim.Scene:
    return bubblesim.Scene(scene)


def _require_settable(name: str, property_name: str) -> None:
    found = vars(bubblesim.Object).get(property_name)
    if getattr(found, "fset", None) is None:
        settable = sorted(key for key, value in vars(bubblesim.Object).items() if getattr(value, "fset", None))
        raise SweepError(
            f"{name}: objects have no property {property_name!r} that can be set{_one_of(property_name, settable)}"
        )


def _one_of(name: str, known: Sequence[str]) -> str:
    near = difflib.get_close_matches(name, known, n=1)
    return did_you_mean(near) if near else f"; they have {', '.join(known)}"


def _measure(simulation: bubblesim.Simulation, name: str) -> dict[str, Result]:
    """Return a property of an object; vectors by component."""
    path, property_name = split_name(name)
    if not isinstance(getattr(bubblesim.Object, property_name, None), property):
        names = sorted(key for key, value in vars(bubblesim.Object).items() if isinstance(value, property))
        raise SweepError(f"{name}: objects have no property {property_name!r}{_one_of(property_name, names)}")
    value = getattr(simulation.object(path), property_name)
    if getattr(value, "shape", None) in ((3,), (4,)):
        return {f"{name}.{axis}": number for axis, number in zip("xyzw", value.tolist(), strict=False)}
    if not isinstance(value, int | float | str):
        raise SweepError(f"{name}: a {type(value).__name__} cannot be a result, only numbers, strings and vectors can")
    return {name: value}


def _checked(returned: Any, task: Task) -> dict[str, Result]:
    """Return the results with Python's own types."""
    if not isinstance(returned, Mapping):
        raise TypeError(f"run() must return a dict of results, found {type(returned).__name__}")
    results: dict[str, Result] = {}
    taken = {"seed", "error", *dict(task.parameters)}
    for name, value in returned.items():
        plain = value.item() if hasattr(value, "item") and getattr(value, "shape", None) == () else value
        if not isinstance(name, str) or name in taken:
            raise ValueError(f"the result {name!r} needs another name: a string, and not {', '.join(sorted(taken))}")
        if plain is not None and not isinstance(plain, int | float | str):
            raise TypeError(f"the result {name!r} must be a number, text, bool or None, found {type(value).__name__}")
        results[name] = plain
    return results


def _traceback_in(file: str, error: BaseException) -> str:
    """Return the traceback from the first line in a file on; the whole one if no line is in it."""
    frames = traceback.extract_tb(error.__traceback__)
    start = next((index for index, frame in enumerate(frames) if frame.filename == file), None)
    if start is None:
        return f"{type(error).__name__}: {error}"
    lines = [*traceback.format_list(frames[start:]), *traceback.format_exception_only(error)]
    return "".join(lines).rstrip()
