# SPDX-License-Identifier: BSD-3-Clause
"""Compare lidars and a camera among 200 boxes with those of PyBullet and MuJoCo.

    python benchmarks/rays/peers.py [--rounds N]

Needs the workspace and `pip install pybullet==3.2.7 mujoco`. The candidates run alternately in every round, so that
other load affects them equally; the table shows medians over the rounds. The scene is the same for all; the program
first compares the ranges.
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
import time
from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np
import pybullet

import bubblesim

RNG = np.random.default_rng(3)
EYE = np.array([0.0, 0.0, 0.5])
REACH = 30.0
WIDTH, HEIGHT, FOV = 640, 480, 1.2
SUN = np.array([0.4, 0.3, -1.0])
Array = np.ndarray[Any, Any]


def boxes() -> list[tuple[Array, Array, float]]:
    """Return the size, position and heading of each box."""
    found: list[tuple[Array, Array, float]] = []
    while len(found) < 200:
        position = np.append(RNG.uniform(-15, 15, 2), 0.5)
        if np.hypot(*position[:2]) > 3:
            found.append((np.append(RNG.uniform(0.2, 1.5, 2), 1.0), position, RNG.uniform(-3, 3)))
    return found


def directions(samples: int, rings: int) -> Array:
    """Return the directions of the rays of a lidar, ring by ring."""
    left = np.linspace(-np.pi, np.pi, samples)
    up = np.linspace(-0.26, 0.26, rings) if rings > 1 else np.zeros(1)
    up, left = (grid.ravel() for grid in np.meshgrid(up, left, indexing="ij"))
    return np.stack([np.cos(up) * np.cos(left), np.cos(up) * np.sin(left), np.sin(up)], axis=1)


def sdf(scene: list[tuple[Array, Array, float]]) -> str:
    """Return the scene as SDFormat, with the sensors on a mast."""

    def words(values: Any) -> str:
        return " ".join(map(str, values))

    def lidar(name: str, samples: int, rings: int) -> str:
        reach = 0.26 if rings > 1 else 0
        return f"""<sensor name="{name}" type="lidar"><lidar><scan><horizontal>
            <samples>{samples}</samples><min_angle>{-np.pi}</min_angle><max_angle>{np.pi}</max_angle></horizontal>
            <vertical><samples>{rings}</samples>
            <min_angle>{-reach}</min_angle><max_angle>{reach}</max_angle></vertical></scan>
            <range><min>0</min><max>{REACH}</max></range></lidar></sensor>"""

    models = "".join(
        f"""<model name="Box{i}"><static>true</static><pose>{words(position)} 0 0 {heading}</pose><link name="l">
        <collision name="c"><geometry><box><size>{words(size)}</size></box></geometry></collision></link></model>"""
        for i, (size, position, heading) in enumerate(scene)
    )
    return f"""<sdf version="1.9"><world name="w"><light name="sun" type="directional">
        <direction>{words(SUN)}</direction>
        <cast_shadows>true</cast_shadows></light>
        <model name="Ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry>
        </collision></link></model>{models}
        <model name="Mast"><static>true</static><pose>{words(EYE)} 0 0 0</pose><link name="l">
        {lidar("Flat", 360, 1)}{lidar("Rings", 1800, 16)}
        <sensor name="Camera" type="camera"><camera><horizontal_fov>{FOV}</horizontal_fov><image><width>{WIDTH}</width>
        <height>{HEIGHT}</height></image><clip><near>0.05</near><far>100</far></clip></camera></sensor>
        </link></model></world></sdf>"""


class Bubblesim:
    """The Python module of bubblesim."""

    def __init__(self, scene: list[tuple[Array, Array, float]]) -> None:
        """Load the scene from a file."""
        with tempfile.NamedTemporaryFile("w", suffix=".sdf") as file:
            file.write(sdf(scene))
            file.flush()
            self._simulation = bubblesim.Simulation(file.name)
        self._world = self._simulation.world

    def lidar(self, samples: int) -> Callable[[], Array]:
        """Return a function that measures and returns the ranges."""
        sensor = self._world.find("/Flat" if samples == 360 else "/Rings")
        return lambda: bubblesim._core.measure_lidar(self._simulation, sensor).ranges.ravel()

    def camera(self) -> Callable[[], Array]:
        """Return a function that renders an image."""
        sensor = self._world.find("/Camera")
        return lambda: bubblesim._core.measure_camera(self._simulation, sensor).rgb


class Bullet:
    """PyBullet: rayTestBatch and TinyRenderer."""

    def __init__(self, scene: list[tuple[Array, Array, float]]) -> None:
        """Build the scene."""
        self._client = pybullet.connect(pybullet.DIRECT)
        pybullet.createMultiBody(0, pybullet.createCollisionShape(pybullet.GEOM_PLANE))
        ground = pybullet.createVisualShape(pybullet.GEOM_BOX, halfExtents=[500, 500, 0.5])
        pybullet.createMultiBody(0, -1, ground, [0, 0, -0.5])
        for size, position, heading in scene:
            shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=size / 2)
            look = pybullet.createVisualShape(pybullet.GEOM_BOX, halfExtents=size / 2)
            turn = pybullet.getQuaternionFromEuler([0, 0, heading])
            pybullet.createMultiBody(0, shape, look, position, turn)

    def lidar(self, samples: int) -> Callable[[], Array]:
        """See Bubblesim.lidar."""
        rays = directions(samples, 1 if samples == 360 else 16)
        ends = EYE + rays * REACH
        starts = np.broadcast_to(EYE, ends.shape)
        # rayTestBatch accepts about 16,000 rays at most.
        parts = [(starts[i : i + 14400], ends[i : i + 14400]) for i in range(0, len(ends), 14400)]

        def scan() -> Array:
            hits = [hit for start, end in parts for hit in pybullet.rayTestBatch(start, end, numThreads=1)]
            return np.array([hit[2] * REACH if hit[0] >= 0 else np.inf for hit in hits])

        return scan

    def camera(self) -> Callable[[], Array]:
        """See Bubblesim.camera."""
        view = pybullet.computeViewMatrix(EYE, EYE + np.array([1, 0, 0]), [0, 0, 1])
        upright = 2 * np.arctan(np.tan(FOV / 2) * HEIGHT / WIDTH)
        projection = pybullet.computeProjectionMatrixFOV(np.rad2deg(upright), WIDTH / HEIGHT, 0.05, 100)

        def render() -> Array:
            _, _, rgba, _, _ = pybullet.getCameraImage(
                WIDTH,
                HEIGHT,
                view,
                projection,
                lightDirection=-SUN,
                shadow=1,
                renderer=pybullet.ER_TINY_RENDERER,
                flags=pybullet.ER_NO_SEGMENTATION_MASK,
            )
            return np.reshape(rgba, (HEIGHT, WIDTH, 4))

        return render


class MuJoCo:
    """MuJoCo: mj_multiRay. Its renderer needs a display or a GPU."""

    def __init__(self, scene: list[tuple[Array, Array, float]]) -> None:
        """Build the scene as MJCF."""
        geoms = "".join(
            f'<geom type="box" size="{" ".join(map(str, size / 2))}" pos="{" ".join(map(str, position))}"'
            f' euler="0 0 {np.rad2deg(heading)}"/>'
            for size, position, heading in scene
        )
        self._model = mujoco.MjModel.from_xml_string(
            f'<mujoco><worldbody><geom type="plane" size="500 500 1"/>{geoms}</worldbody></mujoco>'
        )
        self._data = mujoco.MjData(self._model)
        mujoco.mj_forward(self._model, self._data)

    def lidar(self, samples: int) -> Callable[[], Array]:
        """See Bubblesim.lidar."""
        rays = directions(samples, 1 if samples == 360 else 16)
        flat = rays.ravel()
        hits = np.empty(len(rays), np.int32)
        ranges = np.empty(len(rays))
        extra = [] if "normal" not in (mujoco.mj_multiRay.__doc__ or "") else [None]

        def scan() -> Array:
            mujoco.mj_multiRay(self._model, self._data, EYE, flat, None, 1, -1, hits, ranges, *extra, len(rays), REACH)
            return ranges

        return scan


def check(name: str, ours: Array, theirs: Array) -> None:
    """Print how many of the common ranges differ by more than one millimetre."""
    both = np.isfinite(ours) & (theirs > 0) & np.isfinite(theirs)
    apart = np.abs(ours[both] - theirs[both]) > 1e-3
    print(f"{name}: of {both.sum()} ranges {apart.sum()} differ by more than 1 mm")


def main() -> None:
    """Measure all candidates alternately."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rounds", type=int, default=11)
    rounds = parser.parse_args().rounds
    scene = boxes()
    ours, bullet, other = Bubblesim(scene), Bullet(scene), MuJoCo(scene)
    cases: dict[str, dict[str, Callable[[], Array]]] = {
        "lidar 360": {"bubblesim": ours.lidar(360), "PyBullet": bullet.lidar(360), "MuJoCo": other.lidar(360)},
        "lidar 16 x 1800": {"bubblesim": ours.lidar(1800), "PyBullet": bullet.lidar(1800), "MuJoCo": other.lidar(1800)},
        "camera 640 x 480": {"bubblesim": ours.camera(), "PyBullet": bullet.camera()},
    }
    for name, candidates in cases.items():
        if name.startswith("lidar"):
            for peer in ("PyBullet", "MuJoCo"):
                check(f"{name}, {peer}", candidates["bubblesim"](), candidates[peer]())
        times: dict[str, list[float]] = {candidate: [] for candidate in candidates}
        used: dict[str, list[float]] = {candidate: [] for candidate in candidates}
        for _ in range(rounds):
            for candidate, call in candidates.items():
                start, cpu = time.perf_counter(), time.process_time()
                call()
                times[candidate].append(time.perf_counter() - start)
                used[candidate].append(time.process_time() - cpu)
        for unit, values in (("time", times), ("CPU time", used)):
            own = statistics.median(values["bubblesim"])
            row = ", ".join(f"{peer} {statistics.median(t) / own:.1f} x the {unit}" for peer, t in values.items())
            print(f"{name}: {own * 1e3:.3f} ms; {row}")


if __name__ == "__main__":
    main()
