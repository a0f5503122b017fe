# SPDX-License-Identifier: BSD-3-Clause
"""Runs a scene with its controller, prints the progress and writes a plot at the end."""

from __future__ import annotations

import re
import sys
import tempfile
import time
from pathlib import Path

from bubblesim.running.master import provide_master, simulated_time
from bubblesim.running.places import page_folder
from bubblesim.running.processes import Programs, RunError
from bubblesim.running.recording import Recording
from bubblesim.running.ros_home import use_writable_ros_home
from bubblesim.running.stop import Stop, wait_for

_CONTROLLERS = {"tricycle": "tricycle_avoid.py"}  # the other scenes start their controller or need none
_MIN_DISTANCE = 0.01  # m: a shorter path counts as no motion


def watch(recording: Recording, seconds: float, programs: Programs, stop: Stop) -> None:
    """Print the progress until the time is over or a stop is requested: on a terminal in one updated line."""
    on_terminal = sys.stdout.isatty()
    end = time.monotonic() + seconds
    next_line = 0.0
    while not stop.requested and time.monotonic() < end:
        programs.check()
        if time.monotonic() >= next_line:
            next_line = time.monotonic() + (0.5 if on_terminal else 2.0)
            print(f"\r\033[K{recording.live_line()}" if on_terminal else recording.live_line(), end="", flush=True)
            print(end="" if on_terminal else "\n", flush=True)
        time.sleep(0.05)
    if on_terminal:
        print()


def run(scene: str, seconds: float, picture: Path) -> None:
    """Run the whole demonstration."""
    stop = Stop()
    recording = Recording()
    with tempfile.TemporaryDirectory(prefix="bubblesim-demo-") as logs, Programs(Path(logs)) as programs:
        use_writable_ros_home()
        provide_master(programs, stop)
        if stop.requested:
            return
        with simulated_time():
            from bubblesim.running.observer import Observer  # a ROS node: it needs a master

            observer = Observer(recording)
            simulator = programs.start("simulator", "rosrun", "bubblesim", "sim", scene, *_window())
            controller = _CONTROLLERS.get(Path(scene).stem)
            if controller:
                programs.start("controller", "rosrun", "bubblesim", controller)
            wait_for(lambda: len(recording.samples) > 1, "the robot's pose on /tf", programs, stop)
            if window := re.search(r"the window is at .* (xdg-open \S+)", simulator.output()):
                print(f"window             {window[1]}", flush=True)
            if recording.samples:
                watch(recording, seconds, programs, stop)
            observer.close()
    if len(recording.samples) < 2:
        raise RunError("stopped before the robot's pose was known")
    from bubblesim.running.picture import draw  # matplotlib loads slowly: not before the run

    draw(scene, recording, picture)
    print(f"{recording.summary()}\npicture            {picture}", flush=True)
    if recording.distance() < _MIN_DISTANCE and not stop.requested:
        raise RunError(
            f"nothing moved in {seconds:g} s; if no program sends commands to the robot of '{Path(scene).stem}', drive "
            f"it yourself: rosrun bubblesim sim {scene} --web, and the keys W, A, S, D in the window"
        )


def _window() -> list[str]:
    """Return the option for the window, if its page is built."""
    try:
        page_folder()
    except RunError:
        return []
    return ["--web"]
