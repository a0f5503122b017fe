# SPDX-License-Identifier: BSD-3-Clause
"""The parts of the window's palette as SDFormat."""

import math
from pathlib import Path

import pytest

from bubblesim import SceneError, Simulation
from bubblesim.scene_state.building_parts import MATERIALS, Options, kinds, part


def load(tmp_path: Path, text: str) -> Simulation:
    file = tmp_path / "part.sdf"
    file.write_text(text)
    return Simulation(str(file))


@pytest.mark.parametrize("kind", kinds())
def test_each_part_is_a_model_that_loads(tmp_path: Path, kind: str) -> None:
    assert load(tmp_path, part(kind, "Part", Options())).object("/Part").handle >= 0


@pytest.mark.parametrize(
    ("kind", "size", "volume"),
    [
        ("box", (0.2, 0.3, 0.4), 0.2 * 0.3 * 0.4),
        ("sphere", (0.2, 0.2, 0.2), math.pi / 6 * 0.2**3),
        ("cylinder", (0.2, 0.2, 0.4), math.pi * 0.1**2 * 0.4),
        ("cone", (0.2, 0.2, 0.3), math.pi * 0.1**2 * 0.3 / 3),
        ("capsule", (0.2, 0.2, 0.5), math.pi * 0.1**2 * 0.3 + math.pi / 6 * 0.2**3),
    ],
)
def test_the_mass_of_a_shape_is_its_volume_times_the_density(
    tmp_path: Path, kind: str, size: tuple[float, ...], volume: float
) -> None:
    simulation = load(tmp_path, part(kind, "Part", Options(size, "steel")))
    assert simulation.world.mass(simulation.object("/Part").handle) == pytest.approx(
        MATERIALS["steel"].density * volume
    )


def test_the_name_of_a_carrier_is_text(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="its carrier 'a<b>&c' is no link"):
        load(tmp_path, part("imu", "Part", Options(carrier="a<b>&c")))
