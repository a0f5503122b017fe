# SPDX-License-Identifier: BSD-3-Clause
"""GPS receivers, compared with geodesics on WGS84 from Geodesic.WGS84.Direct of geographiclib 2.0 (PyPI)."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bubblesim

EXACT = 2e-9  # degrees: 0.2 mm
MUNICH, SYDNEY = (48.137, 11.575), (-33.86, 151.21)

# Start, azimuth from north in degrees, distance in m, and end.
GEODESICS = [
    (MUNICH, 90.0, 1000.0, (48.13699921468766, 11.58843588288138)),
    (MUNICH, 0.0, 1000.0, (48.145993365871384, 11.575)),
    (MUNICH, 37.0, 250.0, (48.13879558868751, 11.577021549551814)),
    (SYDNEY, 90.0, 1000.0, (-33.85999952629144, 151.22080659674833)),
    (SYDNEY, 0.0, 1000.0, (-33.85098447533019, 151.21)),
    (SYDNEY, 37.0, 250.0, (-33.85819996079692, 151.2116258589613)),
]


def scene(
    folder: Path, origin: tuple[float, float], place: tuple[float, float], heading: float = 0.0, noise: str = ""
) -> bubblesim.Simulation:
    """A receiver on a floating body in a scene whose origin is 500 m above the ellipsoid."""
    file = folder / "scene.sdf"
    file.write_text(
        f"""<sdf version="1.9"><world name="w">
          <gravity>0 0 0</gravity>
          <spherical_coordinates>
            <surface_model>EARTH_WGS84</surface_model>
            <latitude_deg>{origin[0]}</latitude_deg><longitude_deg>{origin[1]}</longitude_deg>
            <elevation>500</elevation><heading_deg>{heading}</heading_deg>
          </spherical_coordinates>
          <model name="Body"><pose>{place[0]} {place[1]} 0 0 0 0</pose><link name="link">
            <sensor name="Gps" type="navsat"><navsat>{noise}</navsat></sensor>
          </link></model>
        </world></sdf>"""
    )
    return bubblesim.Simulation(str(file))


def reading(simulation: bubblesim.Simulation) -> Any:
    simulation.step()
    return simulation.object("/Gps").reading


@pytest.mark.parametrize(("origin", "azimuth", "distance", "end"), GEODESICS)
def test_places_lie_where_geodesics_lead(
    tmp_path: Path, origin: tuple[float, float], azimuth: float, distance: float, end: tuple[float, float]
) -> None:
    # The scene is a plane; at 1 km, the footpoints on the ellipsoid have the same distance to within 0.1 mm.
    there = math.radians(azimuth)
    gps = reading(scene(tmp_path, origin, (distance * math.sin(there), distance * math.cos(there))))
    scale = 1 - 500.0 / 6.37e6  # 500 m above, the same distance covers a smaller angle
    assert gps.latitude == pytest.approx(origin[0] + (end[0] - origin[0]) * scale, abs=1e-7)
    assert gps.longitude == pytest.approx(origin[1] + (end[1] - origin[1]) * scale, abs=2e-7)
    # The Earth curves away below the plane by d^2 / 2 R.
    assert gps.altitude - 500.0 == pytest.approx(distance**2 / (2 * 6.37e6), rel=0.01)


def test_a_heading_turns_the_scene_from_the_east_to_the_north(tmp_path: Path) -> None:
    gps = reading(scene(tmp_path, MUNICH, (1000.0, 0.0), heading=90.0))
    assert gps.longitude == pytest.approx(MUNICH[1], abs=EXACT)
    assert gps.latitude > MUNICH[0] + 0.008


def test_velocities_are_east_north_up(tmp_path: Path) -> None:
    simulation = scene(tmp_path, MUNICH, (0.0, 0.0), heading=90.0)
    simulation.object("/Body").linear_velocity = [3.0, 4.0, 5.0]
    np.testing.assert_allclose(reading(simulation).velocity, [-4.0, 3.0, 5.0], atol=1e-5)


def test_noise_is_of_metres_and_can_be_repeated(tmp_path: Path) -> None:
    noise = """<position_sensing><horizontal><noise type="gaussian"><stddev>2</stddev></noise></horizontal>
      <vertical><noise type="gaussian"><stddev>5</stddev></noise></vertical></position_sensing>"""

    def altitudes_and_norths() -> np.ndarray[Any, Any]:
        simulation = scene(tmp_path, MUNICH, (0.0, 0.0), noise=noise)
        found = [reading(simulation) for _ in range(400)]
        return np.array([[gps.altitude, (gps.latitude - MUNICH[0]) * 111_000] for gps in found])

    values = altitudes_and_norths()
    np.testing.assert_allclose(values.std(axis=0), [5.0, 2.0], rtol=0.15)
    np.testing.assert_allclose(values.mean(axis=0), [500.0, 0.0], atol=1.0)
    np.testing.assert_array_equal(values, altitudes_and_norths())
