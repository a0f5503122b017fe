# SPDX-License-Identifier: BSD-3-Clause
"""The theoretical values of the experiments, derived a second time."""

import math

import numpy as np
import pytest

from experiments import friction, geodesy, mechanisms, rotation, vehicles
from experiments.mechanics import complete_elliptic_integral, crossings, runge_kutta


def test_elliptic_integral_has_known_values() -> None:
    assert complete_elliptic_integral(0.0) == pytest.approx(math.pi / 2)
    assert complete_elliptic_integral(math.sqrt(0.5)) == pytest.approx(1.8540746773013719)  # Abramowitz and Stegun


def test_flips_by_integration_of_eulers_equations() -> None:
    i1, i2, i3 = rotation.TENNIS_RACKET.inertia

    def rates(w: np.ndarray) -> np.ndarray:
        return np.array([(i2 - i3) / i1 * w[1] * w[2], (i3 - i1) / i2 * w[2] * w[0], (i1 - i2) / i3 * w[0] * w[1]])

    states = runge_kutta(rates, np.array(rotation.START), 0.001, 15000)
    flips = crossings(list(0.001 * np.arange(len(states))), [float(w[1]) for w in states])
    assert np.diff(flips) == pytest.approx(rotation.dzhanibekov_theory(0.001), rel=1e-4)


@pytest.mark.parametrize("degrees", [30.0, 170.0])
def test_period_of_a_pendulum_by_integration(degrees: float) -> None:
    bob = rotation.BOB
    pull = bob.mass * 9.81 * rotation.LENGTH / (bob.mass * rotation.LENGTH**2 + bob.inertia[1])
    start = np.array([math.radians(degrees), 0.0])
    states = runge_kutta(lambda s: np.array([s[1], -pull * math.sin(s[0])]), start, 0.001, 12000)
    passes = crossings(list(0.001 * np.arange(len(states))), [float(s[0]) for s in states])
    assert 2 * np.diff(passes)[0] == pytest.approx(rotation.pendulum_theory(degrees, 0.005), rel=1e-6)


def test_skid_steering_has_a_closed_form() -> None:
    for base, track in ((0.5, 0.4), (0.4, 0.4), (0.3, 0.4)):
        assert vehicles.skid_steer_theory(base, track) == pytest.approx(2 * track * 0.5 / (track**2 + base**2))


def test_braking_of_light_wheels_is_the_textbooks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(vehicles, "WHEEL", 0.0)
    g, mu, ratio = 9.81, 0.5, 0.6  # ratio of height and wheel base
    assert vehicles.braking_theory("rear", 0.0) == pytest.approx(mu * g / 2 / (1 + mu * ratio))
    assert vehicles.braking_theory("front", 0.0) == pytest.approx(mu * g / 2 / (1 - mu * ratio))
    for mu, ratio in ((1.0, 0.56), (1.5, 0.7)):
        assert vehicles.load_transfer_theory("rear", "forward", mu, ratio) == pytest.approx(
            mu * g / 2 / (1 + mu * ratio)
        )


def test_ladder_of_pointed_feet_is_the_textbooks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(friction, "FOOT", 0.0)
    for mu in (0.5, 0.8):
        assert math.tan(math.radians(friction.ladder_theory(mu))) == pytest.approx((1 - mu**2) / (2 * mu))


def test_local_coordinates_near_the_origin_follow_the_radii_of_curvature() -> None:
    origin = (48.1, 11.6, 300.0)
    s = math.sin(math.radians(origin[0]))
    w = math.sqrt(1 - geodesy.ECCENTRICITY2 * s * s)
    north = geodesy.MAJOR * (1 - geodesy.ECCENTRICITY2) / w**3 + 300
    east = (geodesy.MAJOR / w + 300) * math.cos(math.radians(origin[0]))
    x, y, z = geodesy.to_local(origin[0] + 1e-5, origin[1] + 2e-5, 301.0, origin)
    assert (x, y) == pytest.approx((math.radians(2e-5) * east, math.radians(1e-5) * north), rel=1e-5)
    assert z == pytest.approx(1.0, abs=1e-6)


def test_pads_bear_pure_torsion_and_pure_weight() -> None:
    assert friction.pads_theory(1.0) == pytest.approx(0, abs=1e-3)
    assert 1e-3 * friction.pads_theory(1e-3) == pytest.approx(friction.PAD / math.sqrt(2), rel=1e-3)


def test_casters_follow_the_tractrix_by_integration() -> None:
    def rate(angle: np.ndarray) -> np.ndarray:
        return -np.sin(angle) / mechanisms.TRAIL

    way = mechanisms.caster_theory(0.001)
    (angle,) = runge_kutta(rate, np.array([mechanisms.START]), way / 1000, 1000)[-1]
    assert angle == pytest.approx(math.pi / 2, abs=1e-9)


@pytest.mark.parametrize("angle", [0.3, 2.0, 4.5])
def test_bars_of_closed_loops_keep_their_length(angle: float) -> None:
    pin = mechanisms.CRANK * np.array([math.cos(angle), math.sin(angle)])
    wrist = np.array([mechanisms.piston(angle) + mechanisms.CRANK + mechanisms.ROD, 0])
    assert np.linalg.norm(wrist - pin) == pytest.approx(mechanisms.ROD)
    crank, coupler, rocker, ground = mechanisms.SIDES
    turn = mechanisms.rocker(angle)
    end = np.array([ground + rocker * math.cos(turn), rocker * math.sin(turn)])
    pin = crank * np.array([math.cos(angle), math.sin(angle)])
    assert np.linalg.norm(end - pin) == pytest.approx(coupler)
