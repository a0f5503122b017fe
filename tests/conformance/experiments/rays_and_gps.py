# SPDX-License-Identifier: BSD-3-Clause
"""Lidars against shapes whose intersections with lines are known, and GPS against the ellipsoid. Only bubblesim."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance, product_of
from .geodesy import to_local
from .mechanics import rotation
from .scene import Body, Model, Quaternion, Scene, Shape, Vector, sphere_inertia


def exact(**case: Any) -> float:
    """The nearest intersection of a line with the shape: a quadratic equation, or the slabs of a box."""
    return 0.0


def hit_sphere(start: np.ndarray, direction: np.ndarray, size: tuple[float, ...]) -> float:
    """Return the distance to a sphere."""
    b, c = float(start @ direction), float(start @ start) - size[0] ** 2
    root = b * b - c
    return -b - math.sqrt(root) if root >= 0 and -b - math.sqrt(root) > 0 else math.inf


def hit_box(start: np.ndarray, direction: np.ndarray, size: tuple[float, ...]) -> float:
    """Return the distance to a box (Kay and Kajiya 1986)."""
    with np.errstate(divide="ignore"):
        a, b = (-np.array(size) / 2 - start) / direction, (np.array(size) / 2 - start) / direction
    near, far = float(np.max(np.minimum(a, b))), float(np.min(np.maximum(a, b)))
    return near if 0 < near <= far else math.inf


def hit_cylinder(start: np.ndarray, direction: np.ndarray, size: tuple[float, ...]) -> float:
    """Return the distance to a cylinder along z."""
    radius, half = size[0], size[1] / 2
    found = []
    a = float(direction[:2] @ direction[:2])
    b, c = float(start[:2] @ direction[:2]), float(start[:2] @ start[:2]) - radius**2
    root = b * b - a * c
    if root >= 0 and a > 0:
        t = (-b - math.sqrt(root)) / a
        if abs(start[2] + t * direction[2]) <= half:
            found.append(t)
    for side in (-half, half):
        if direction[2]:
            t = float((side - start[2]) / direction[2])
            if np.linalg.norm((start + t * direction)[:2]) <= radius:
                found.append(t)
    return min((t for t in found if t > 0), default=math.inf)


HITS: dict[str, tuple[Callable[..., float], tuple[float, ...]]] = {
    "sphere": (hit_sphere, (0.7,)),
    "box": (hit_box, (0.8, 1.2, 0.6)),
    "cylinder": (hit_cylinder, (0.5, 1.4)),
}


def random_turn(rng: np.random.Generator) -> Quaternion:
    """Return a random rotation."""
    q = rng.normal(size=4)
    q /= np.linalg.norm(q)
    return (float(q[0]), float(q[1]), float(q[2]), float(q[3]))


def rays(engine: Any, shape: str, distance: float) -> float:
    """Return the greatest error of a turned lidar of 8 x 240 rays that looks at four turned bodies, m.

    Rays that pass an edge within 0.1 mrad may hit or miss.
    """
    rng = np.random.default_rng(11)
    hit, size = HITS[shape]
    lidar = """<sensor name="lidar" type="lidar"><lidar><scan>
        <horizontal><samples>240</samples><min_angle>-3.1</min_angle><max_angle>3.1</max_angle></horizontal>
        <vertical><samples>8</samples><min_angle>-0.4</min_angle><max_angle>0.4</max_angle></vertical></scan>
        <range><min>0.1</min><max>200</max></range></lidar></sensor>"""
    turn = random_turn(rng)
    eye: Vector = (1.0, -2.0, 3.0)
    models = [Model("eye", (Body("eye", 1.0, sphere_inertia(1.0, 0.1), sensors=lidar),), (), eye, turn)]
    for i in range(4):
        way = rotation(turn) @ np.array([math.cos(1.5 * i), math.sin(1.5 * i), 0.1])
        place = np.array(eye) + distance * way
        body = Body(f"target{i}", 1.0, sphere_inertia(1.0, 0.5), (Shape(shape, size),))
        models.append(Model(f"target{i}", (body,), (), tuple(map(float, place)), random_turn(rng)))  # type: ignore[arg-type]
    world = engine(Scene(tuple(models), gravity=(0, 0, 0), ground=False))
    world.run(0.005)
    scan = world.simulation.object("/lidar").reading
    worst, hits = 0.0, 0
    frame = rotation(turn)
    for ring, elevation in enumerate(scan.elevations):
        for sample, angle in enumerate(scan.angles):
            ray = np.array(
                [
                    math.cos(elevation) * math.cos(angle),
                    math.cos(elevation) * math.sin(angle),
                    math.sin(elevation),
                ]
            )
            expected = nearest(np.array(eye), frame @ ray, models[1:], hit)
            measured = float(scan.ranges[ring, sample])
            if math.isfinite(expected) and math.isfinite(measured):
                hits += 1
                worst = max(worst, abs(measured - expected))
            elif math.isfinite(expected) != math.isfinite(measured) and not grazes(
                np.array(eye), frame, ray, models[1:], hit
            ):
                return math.inf
    return worst if hits > 10 else math.inf


def nearest(start: np.ndarray, direction: np.ndarray, models: list[Model], hit: Callable[..., float]) -> float:
    """Return the distance to the nearest of the bodies."""
    distances = []
    for model in models:
        turn = rotation(model.orientation).T
        distances.append(
            hit(turn @ (start - np.array(model.position)), turn @ direction, model.bodies[0].shapes[0].size)
        )
    return min(distances)


def grazes(
    start: np.ndarray, frame: np.ndarray, ray: np.ndarray, models: list[Model], hit: Callable[..., float]
) -> bool:
    """Return whether the rays around this one both hit and miss."""
    around = [
        ray + 1e-4 * np.array(offset)
        for offset in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))
    ]
    found = {math.isfinite(nearest(start, frame @ (r / np.linalg.norm(r)), models, hit)) for r in around}
    return len(found) == 2


def on_earth(**case: Any) -> float:
    """The scene is a plane that touches the ellipsoid WGS84 at its origin; coordinates by Hofmann-Wellenhof et al."""
    return 0.0


def gps(engine: Any, latitude: float, longitude: float, heading: float) -> float:
    """Return the greatest error at five places up to 7 km away, m."""
    origin = (latitude, longitude, 300.0)
    place = f"""<spherical_coordinates><surface_model>EARTH_WGS84</surface_model><latitude_deg>{latitude}</latitude_deg>
        <longitude_deg>{longitude}</longitude_deg><elevation>300</elevation><heading_deg>{heading}</heading_deg>
        </spherical_coordinates>"""
    places = ((0.0, 0.0, 0.0), (10.0, 5.0, 2.0), (-400.0, 900.0, 50.0), (5000.0, -5000.0, 1000.0), (0.0, 3000.0, -20.0))
    models = tuple(
        Model(
            f"car{i}",
            (Body(f"car{i}", 1.0, sphere_inertia(1.0, 0.1), sensors=f'<sensor name="gps{i}" type="navsat"/>'),),
            position=where,
        )
        for i, where in enumerate(places)
    )
    world = engine(Scene(models, gravity=(0, 0, 0), ground=False, world=place))
    world.run(0.005)
    worst = 0.0
    for i, where in enumerate(places):
        reading = world.simulation.object(f"/gps{i}").reading
        found = to_local(reading.latitude, reading.longitude, reading.altitude, origin, heading)
        worst = max(worst, float(np.linalg.norm(found - np.array(where))))
    return worst


EXPERIMENTS = [
    Experiment(
        "rays",
        "Lidar ranges of turned shapes",
        "m",
        exact,
        rays,
        Tolerance("single precision at 10 m is 1e-6 m; cancellation in the quadratic equation", absolute=1e-5),
        product_of(shape=("sphere", "box", "cylinder"), distance=(3.0, 10.0)),
        peers=(),
    ),
    Experiment(
        "gps",
        "GPS positions up to 7 km from the origin",
        "m",
        on_earth,
        gps,
        Tolerance("rounding of doubles at the Earth's radius is 1e-9 m", absolute=1e-6),
        (
            {"latitude": 48.1, "longitude": 11.6, "heading": 0.0},
            {"latitude": -33.9, "longitude": 151.2, "heading": 35.0},
            {"latitude": 0.0, "longitude": -179.9999, "heading": 90.0},
            {"latitude": 89.0, "longitude": 20.0, "heading": -120.0},
        ),
        peers=(),
    ),
]
