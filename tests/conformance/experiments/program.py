# SPDX-License-Identifier: BSD-3-Clause
"""The command scripts/conformance."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from .experiment import Experiment, Result, run
from .ours import Ode, Ours
from .registry import EXPERIMENTS
from .table import markdown, row_text, to_json


def peers() -> list[type]:
    """Return the other engines that are installed."""
    found: list[type] = []
    try:
        import mujoco  # noqa: F401

        from .mujoco_peer import MuJoCo

        found.append(MuJoCo)
    except ImportError:
        print("MuJoCo is not installed (benchmarks/requirements.txt)", file=sys.stderr)
    try:
        import pybullet  # noqa: F401

        from .pybullet_peer import PyBullet

        found.append(PyBullet)
    except ImportError:
        print("PyBullet is not installed (benchmarks/requirements.txt)", file=sys.stderr)
    return found


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the experiments; return 1 if one is out of tolerance."""
    parser = argparse.ArgumentParser(prog="scripts/conformance", description="Compare the physics with theory.")
    parser.add_argument("--only", action="append", metavar="NAME", help="run the experiments whose names contain NAME")
    parser.add_argument("--peers", action="store_true", help="also run MuJoCo and PyBullet, where installed")
    parser.add_argument("--long", action="store_true", help="also run the experiments that take minutes")
    parser.add_argument("--list", action="store_true", help="list the experiments")
    parser.add_argument("--cases", action="store_true", help="show each case")
    parser.add_argument("--json", metavar="FILE", help="write the results")
    parser.add_argument("--markdown", metavar="FILE", help="write the table of docs/physics.md")
    parser.add_argument("--before", metavar="FILE", help="results of another version, for the table")
    parser.add_argument("--plots", metavar="FOLDER", help="draw the plots of docs/physics.md")
    options = parser.parse_args(arguments)
    for part in options.only or ():
        if not any(part in experiment.name for experiment in EXPERIMENTS):
            parser.error(f"no experiment is named '{part}'; --list shows all")
    chosen = [e for e in EXPERIMENTS if not options.only or any(part in e.name for part in options.only)]
    if options.list:
        for experiment in chosen:
            print(f"{experiment.name:20} {experiment.title}{' (long)' if experiment.long else ''}")
        return 0
    engines = [Ours, Ode, *(peers() if options.peers else [])]
    results: dict[str, list[Result]] = {}
    failed = []
    for experiment in chosen:
        if experiment.long and not (options.long or options.only):
            continue
        try:
            results[experiment.name] = [
                measure(experiment, engine)
                for engine in engines
                if issubclass(engine, Ours) or engine.name in experiment.peers
            ]
        except Exception as error:  # the other experiments are of use without this one
            print(f"{experiment.name}: FAIL {error!r}", flush=True)
            failed.append(experiment.name)
            continue
        print(row_text(experiment, results[experiment.name], all_cases=options.cases), flush=True)
        if any(result.failures for result in results[experiment.name][: 2 if experiment.ode else 1]):
            failed.append(experiment.name)
    if options.json:
        to_json(options.json, results)
    if options.markdown:
        markdown(options.markdown, chosen, results, options.before)
    if options.plots:
        from .plots import draw

        draw(options.plots, engines)
    count = len(set(results) | set(failed))
    print(f"{count - len(failed)} of {count} experiments within their tolerance")
    if failed:
        print("out of tolerance:", ", ".join(failed))
    return 1 if failed else 0


def measure(experiment: Experiment, engine: type) -> Result:
    """Run an experiment; show progress on a terminal."""
    show = sys.stderr.isatty()

    def on_case(case: str) -> None:
        if show:
            print(f"\r\033[K{experiment.name}, {engine.name}: {case}", end="\r", file=sys.stderr, flush=True)

    result = run(experiment, engine, on_case)
    if show:
        print("\r\033[K", end="", file=sys.stderr, flush=True)
    return result
