# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim sweep: runs over seeds and parameters."""

from __future__ import annotations

import argparse
import signal
import sys
import time
from pathlib import Path
from typing import Any

_FAILED, _BY_CTRL_C = 1, 130

_DESCRIPTION = """\
Runs a program or a scene with each seed and each combination of parameters, in several processes.

  bubblesim sweep mine.py --seeds 0:1000 --set gain=0.5:2:0.1
  bubblesim sweep tricycle --seeds 0:10 --set /FrontMotor.target_velocity=0.5:1.5:0.25 --duration 20
  bubblesim sweep mine.py --seeds 0:100000 --workers ray://auto --output results.parquet

FILE.py defines run(run), which returns a dict of results; run.seed, run.parameters and run.simulation(SCENE) belong to
the run. A scene is simulated without its scripts. Parameters named /PATH.PROPERTY are set in the simulation.

Finished runs are in OUTPUT.journal: after an interruption the same command continues."""


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "sweep",
        help="run over seeds and parameters",
        description=_DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        usage="bubblesim sweep FILE.py|SCENE [option ...]",
        allow_abbrev=False,
    )
    parser.add_argument("what", metavar="FILE.py|SCENE", help="a program with a function run(run), or a scene")
    parser.add_argument("--seeds", default="0", metavar="FIRST:END", help="seeds, END excluded; or a list: 1,5,9")
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="NAME=FIRST:LAST:STEP",
        help="values of a parameter, LAST included; or a list: NAME=low,high. Give it once for each parameter",
    )
    parser.add_argument(
        "--workers",
        default="local",
        metavar="WORKERS",
        help="local: a process for each CPU; a number of processes; ray: a new Ray on this machine; ray://ADDRESS: a "
        "cluster, ray://auto: that of this machine (default: local)",
    )
    parser.add_argument("--output", type=Path, metavar="FILE", help=".csv or .parquet (default: NAME-sweep.csv)")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="plot the results to a .png, .pdf or .svg file")
    parser.add_argument("--fresh", action="store_true", help="repeat the runs that the journal has")
    parser.add_argument("--duration", type=float, metavar="S", help="of a scene, simulated seconds (default: 10)")
    parser.add_argument(
        "--measure",
        action="append",
        default=[],
        metavar="/PATH.PROPERTY",
        help="result of a scene: a property at the end (default: the positions of the models that can move)",
    )
    parser.set_defaults(command=_sweep, parser=parser)


def _sweep(options: argparse.Namespace) -> int:
    from bubblesim.sweeps.results import writer_of
    from bubblesim.sweeps.summary import table
    from bubblesim.sweeps.sweep import make_workers, run_sweep
    from bubblesim.sweeps.tasks import SweepError, parse_seeds, parse_setting, tasks_of

    settings = [parse_setting(text) for text in options.set]
    parameters = dict(settings)
    if len(parameters) < len(settings):
        raise SweepError("--set is given twice for the same parameter; list its values: NAME=1,2,3")
    tasks = tasks_of(parse_seeds(options.seeds), parameters)
    program = _program(options)
    program.check(list(parameters))
    output = options.output or Path(f"{program.name}-sweep.csv")
    write = writer_of(output)
    journal = output.with_name(output.name + ".journal")
    workers = make_workers(options.workers, program)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    progress = _ProgressBar()
    try:
        rows = run_sweep(program, tasks, workers, journal, fresh=options.fresh, on_progress=progress.show)
    except KeyboardInterrupt:
        progress.end()
        print(f"interrupted: {journal} has the finished runs; the same command continues", file=sys.stderr)
        return _BY_CTRL_C
    finally:
        progress.end()
    write(rows, output)
    swept = [name for name, values in parameters.items() if len(values) > 1]
    print(table(rows, list(parameters)))
    print(f"results            {output}", file=sys.stderr)
    if options.plot:
        from bubblesim.sweeps.plots import plot  # matplotlib loads slowly

        plot(rows, swept, options.plot)
        print(f"plots              {options.plot}", file=sys.stderr)
    errors = [str(row["error"]) for row in rows if row.get("error")]
    if errors:
        print(f"{len(errors)} of {len(rows)} runs failed, the first one: {errors[0]}", file=sys.stderr)
        print(f"                   {journal} has their tracebacks", file=sys.stderr)
        return _FAILED
    return 0


def _program(options: argparse.Namespace) -> Any:
    from bubblesim.sweeps.programs import FileProgram, SceneProgram
    from bubblesim.sweeps.tasks import SweepError

    if not options.what.endswith(".py"):
        duration = 10.0 if options.duration is None else options.duration
        if not 0.0 < duration < 1e9:
            raise SweepError(f"--duration must be above 0 s, found {duration}")
        return SceneProgram(options.what, duration, tuple(options.measure))
    if options.duration is not None or options.measure:
        raise SweepError("--duration and --measure are for scenes; a program decides itself what it runs and returns")
    return FileProgram.read(Path(options.what))


class _ProgressBar:
    """Shows the ended runs on stderr: on a terminal ten times a second at most, otherwise every 30 s."""

    def __init__(self) -> None:
        self._begin = time.monotonic()
        self._shown = -1e9
        self._first = 0  # runs that ended earlier
        self._on_terminal = sys.stderr.isatty()

    def show(self, done: int, failed: int, total: int) -> None:
        now = time.monotonic()
        if self._shown < 0.0 and not self._on_terminal:
            self._shown = now
        if self._shown < 0.0:
            self._first = done
        if now - self._shown < (0.1 if self._on_terminal else 30.0) and done < total:
            return
        if not self._on_terminal and done == total:
            return
        self._shown = now
        rate = (done - self._first) / max(now - self._begin, 1e-3)
        text = f"{done}/{total} runs"
        if failed:
            text += f", {failed} failed"
        if rate > 0.0:
            text += f", {rate:.3g}/s, {(total - done) / rate:.0f} s left"
        if self._on_terminal:
            filled = 30 * done // max(total, 1)
            print(f"\r\033[K[{'#' * filled}{'.' * (30 - filled)}] {text}", end="", file=sys.stderr, flush=True)
        else:
            print(text, file=sys.stderr, flush=True)

    def end(self) -> None:
        """Clear the line."""
        if self._on_terminal:
            print("\r\033[K", end="", file=sys.stderr, flush=True)
