# SPDX-License-Identifier: BSD-3-Clause
"""Any number that Python passes to a simulation is accepted and finite, or rejected without effect; none aborts."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import bubblesim

EXTREMES = [math.nan, math.inf, -math.inf, 0.0, -0.0, 1e300, -1e300, 1e12, 1e6, -1e6, 5e-324, 1e-300, 1.0]
NUMBERS = st.sampled_from(EXTREMES) | st.floats()
OBJECTS = ["/Tricycle", "/Tricycle/base_link", "/Steering", "/FrontMotor", "/FrontSonar", "/Floor"]
VECTORS = ["position", "linear_velocity", "angular_velocity"]
AXES = ["target_position", "target_velocity", "max_force"]
SETS = (
    st.tuples(st.sampled_from(VECTORS), st.lists(NUMBERS, min_size=3, max_size=3) | st.lists(NUMBERS, max_size=5))
    | st.tuples(st.just("orientation"), st.lists(NUMBERS, min_size=4, max_size=4) | st.lists(NUMBERS, max_size=5))
    | st.tuples(st.sampled_from(AXES), NUMBERS)
)
REFUSED = (ValueError, TypeError, bubblesim.NoSuchObject)


@pytest.fixture(scope="module")
def simulation() -> bubblesim.Simulation:
    return bubblesim.Simulation("tricycle")


def is_finite(simulation: bubblesim.Simulation) -> bool:
    bodies = [simulation.object(path) for path in OBJECTS[:2]]
    return all(np.isfinite([*body.position, *body.orientation, *body.linear_velocity]).all() for body in bodies)


@settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.lists(st.tuples(st.sampled_from(OBJECTS), SETS), min_size=1, max_size=4))
def test_setters_take_a_value_or_change_nothing(
    simulation: bubblesim.Simulation, commands: list[tuple[str, tuple[str, Any]]]
) -> None:
    simulation.reset()
    for path, (name, value) in commands:
        before = simulation.state_hash()
        refused = ""
        try:
            setattr(simulation.object(path), name, value)
        except REFUSED as error:
            refused = str(error)
        if refused:
            assert simulation.state_hash() == before
            assert path.split("/")[-1] in refused or name in refused
        assert is_finite(simulation)
    try:
        simulation.step()
    except bubblesim.Diverged:
        return
    assert is_finite(simulation)


MODEL = """<sdf version="1.9"><model name="thing"><link name="l">
<inertial><mass>{}</mass><inertia><ixx>{}</ixx><iyy>{}</iyy><izz>{}</izz><ixy>{}</ixy></inertia></inertial>
<collision name="c"><geometry><box><size>{} {} 1</size></box></geometry>
<surface><friction><ode><mu>{}</mu></ode></friction><contact><ode><kp>{}</kp><kd>{}</kd></ode></contact></surface>
</collision></link></model></sdf>"""


@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.lists(NUMBERS | st.floats(0.1, 10), min_size=10, max_size=10), st.lists(NUMBERS, min_size=3, max_size=3))
def test_models_come_in_or_change_nothing(
    simulation: bubblesim.Simulation, numbers: list[float], position: list[float]
) -> None:
    simulation.reset()
    before = simulation.state_hash()
    try:
        model = simulation.add_model(MODEL.format(*numbers), position=position)
    except REFUSED:
        assert simulation.state_hash() == before
        return
    try:
        simulation.step()
    except bubblesim.Diverged:
        simulation.reset()
    simulation.remove_model(model.handle)
