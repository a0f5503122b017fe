# SPDX-License-Identifier: BSD-3-Clause
"""Compare a batch of tricycles with lidars with MuJoCo's rollout and mj_multiRay, on the same number of threads.

    python benchmarks/batch/rollout_peer.py [--rounds N] [--worlds N]

Needs the workspace and `pip install -r benchmarks/requirements.txt`. In each world a tricycle drives in a circle amid
200 boxes, around a lidar of 360 rays that measures every 50 ms. The program first compares the ranges.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from mujoco import rollout

import bubblesim

sys.path.insert(0, str(Path(__file__).parents[1] / "step"))
from peers import SPEED, STEERING, SUBSTEPS, MuJoCo, scene_of

BOXES = 200
RAYS = 360
PLACE = (0, 1.46, 0.25)  # m, the centre of the circle; the rays meet wheels and boxes
FARTHEST = 30.0  # m
STEPS = 20  # of 50 ms, of a round
THREADS = 2
LIDAR = f"""<model name="Lidar"><static>true</static><pose>{" ".join(map(str, PLACE))} 0 0 0</pose><link name="l">
    <sensor name="lidar" type="ray"><ray><scan><horizontal><samples>{RAYS}</samples><min_angle>-3.14159265</min_angle>
    <max_angle>{3.14159265 - 2 * 3.14159265 / RAYS}</max_angle></horizontal></scan>
    <range><min>0.01</min><max>{FARTHEST}</max></range></ray></sensor></link></model>"""


class Ours:
    """A batch."""

    def __init__(self, worlds: int) -> None:
        """Make the worlds and their commands."""
        with tempfile.NamedTemporaryFile("w", suffix=".sdf") as file:
            file.write(scene_of(BOXES, 1, LIDAR))
            file.flush()
            self.batch = bubblesim.Batch(
                file.name,
                worlds,
                threads=THREADS,
                actions=["/FrontMotor.target_velocity", "/Steering.target_position"],
                observations=["/Tricycle0.pose", "/lidar.ranges"],
            )
        self.actions = np.tile(np.float32([SPEED, STEERING]), (worlds, 1))

    def step(self) -> Any:
        """Step all worlds; return the ranges."""
        return self.batch.step(self.actions)[:, 7:]


class Theirs:
    """Rollouts of one step of 50 ms each, then the rays of each world."""

    def __init__(self, worlds: int) -> None:
        """Make the states of the worlds."""
        self.model = MuJoCo(BOXES).model
        self.datas = [mujoco.MjData(self.model) for _ in range(THREADS)]
        full = mujoco.mjtState.mjSTATE_FULLPHYSICS
        state = np.zeros(mujoco.mj_stateSize(self.model, full))
        mujoco.mj_getState(self.model, self.datas[0], state, full)
        self.states = np.tile(state, (worlds, 1))
        self.control = np.tile(np.array([STEERING, SPEED]), (worlds, SUBSTEPS, 1))
        self.rollout = rollout.Rollout(nthread=THREADS)
        self.pool = ThreadPoolExecutor(THREADS)
        angles = np.linspace(-np.pi, np.pi, RAYS, endpoint=False)
        self.rays = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1).ravel()
        self.ranges = np.zeros((worlds, RAYS))

    def step(self) -> Any:
        """Step all worlds; return the ranges."""
        states, _ = self.rollout.rollout(self.model, self.datas, self.states, self.control)
        self.states = states[:, -1]
        list(self.pool.map(self._measure, range(THREADS)))
        return self.ranges

    def _measure(self, thread: int) -> None:
        data, found = self.datas[thread], np.zeros(RAYS, dtype=np.int32)
        origin = np.array(PLACE, dtype=float)
        for world in range(thread, len(self.states), THREADS):
            mujoco.mj_setState(self.model, data, self.states[world], mujoco.mjtState.mjSTATE_FULLPHYSICS)
            mujoco.mj_kinematics(self.model, data)
            ranges = self.ranges[world]
            mujoco.mj_multiRay(self.model, data, origin, self.rays, None, True, -1, found, ranges, None, RAYS, FARTHEST)


def compare(ours: Any, theirs: Any) -> str:
    """Return how far the ranges of the first world are apart."""
    both = np.isfinite(ours[0]) & (theirs[0] >= 0)
    apart = np.abs(ours[0] - theirs[0])[both]
    return f"{both.sum()} of {RAYS} rays meet something in both, {np.median(apart):.1e} m apart (median)"


def main() -> None:
    """Print the ratio."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--worlds", type=int, default=64)
    options = parser.parse_args()
    ours, theirs = Ours(options.worlds), Theirs(options.worlds)
    print(compare(ours.step(), theirs.step()))
    times: dict[Ours | Theirs, list[float]] = {ours: [], theirs: []}
    for _ in range(options.rounds):
        for candidate, taken in times.items():
            begin = time.perf_counter()
            for _ in range(STEPS):
                candidate.step()
            taken.append((time.perf_counter() - begin) / STEPS / options.worlds)
    own, other = (statistics.median(taken) for taken in times.values())
    print(f"bubblesim {1e6 * own:.0f} us, MuJoCo {1e6 * other:.0f} us for each step of a world: {other / own:.2f} x")


if __name__ == "__main__":
    main()
