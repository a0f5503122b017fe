# SPDX-License-Identifier: BSD-3-Clause
"""Adding and removing models in a simulation, from Python."""

import numpy as np
import pytest

import bubblesim

CRATE = """\
<sdf version="1.9">
  <model name="Crate">
    <pose>0 0 1 0 0 0</pose>
    <link name="link">
      <inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
      <collision name="box"><geometry><box><size>0.4 0.4 0.4</size></box></geometry></collision>
    </link>
  </model>
</sdf>
"""
QUARTER_ABOUT_Y = (0, np.sqrt(0.5), 0, np.sqrt(0.5))


def test_a_model_comes_and_goes() -> None:
    simulation = bubblesim.Simulation("ball")
    simulation.step(10)
    crate = simulation.add_model(CRATE)
    np.testing.assert_allclose(crate.position, [0, 0, 1])
    simulation.step(40)
    assert simulation.object("/Crate").position[2] == pytest.approx(0.2, abs=3e-3)
    simulation.remove_model(crate.handle)
    with pytest.raises(bubblesim.NoSuchObject, match="was removed"):
        print(crate.position)
    assert repr(crate) == f"<bubblesim.Object {crate.handle} (removed)>"
    with pytest.raises(bubblesim.NoSuchObject):
        simulation.object("/Crate")
    simulation.step()


def test_name_and_place_may_be_given() -> None:
    simulation = bubblesim.Simulation("ball")
    other = simulation.add_model(CRATE, name="Other", position=[5, 6, 7], orientation=QUARTER_ABOUT_Y)
    assert other.path == "/Other"
    np.testing.assert_allclose(other.position, [5 + 1, 6, 7], atol=1e-12)  # its pose is relative to that frame
    np.testing.assert_allclose(other.orientation, QUARTER_ABOUT_Y)


def test_a_model_may_have_a_script_of_the_scenes_folder() -> None:
    simulation = bubblesim.Simulation("ball")
    text = CRATE.replace("<link", "<bubblesim:child_script>{}</bubblesim:child_script><link", 1)
    simulation.add_model(text.format("ball.py"))
    with pytest.raises(bubblesim.SceneError, match="does not exist"):
        simulation.add_model(text.format("nothing.py"), name="Other")


@pytest.mark.parametrize(
    ("text", "changes", "message"),
    [
        (CRATE, {"name": "Ball"}, "/Ball: a model with this name exists already"),
        (CRATE, {"position": [float("nan"), 0, 0]}, "/Crate: the position is .nan"),
        (CRATE, {"orientation": [0, 0, 0, 0]}, "/Crate: the orientation"),
        (CRATE, {"position": [0, 0]}, "position: expected 3 numbers, found 2"),
        (CRATE.replace("<mass>2", "<mass>0"), {}, "<data-string>:4: /Crate/link: the mass is 0 kg"),
        (CRATE.replace("</link>", ""), {}, "<data-string>:4: is not well-formed XML"),
    ],
)
def test_a_bad_model_is_refused_and_changes_nothing(text: str, changes: dict[str, object], message: str) -> None:
    simulation = bubblesim.Simulation("ball")
    simulation.step(5)
    before, objects = simulation.state_hash(), len(simulation.objects)
    with pytest.raises(ValueError, match=message):
        simulation.add_model(text, **changes)
    assert (simulation.state_hash(), len(simulation.objects)) == (before, objects)


def test_only_models_are_removed() -> None:
    simulation = bubblesim.Simulation("ball")
    with pytest.raises(ValueError, match="/Ball/link is a link: it cannot be removed on its own"):
        simulation.remove_model(simulation.object("/Ball/link").handle)


def test_a_reset_keeps_the_models_that_are_there() -> None:
    simulation = bubblesim.Simulation("ball", seed=1)
    crate = simulation.add_model(CRATE)
    simulation.remove_model(simulation.object("/Ramp").handle)
    start = simulation.state_hash()
    simulation.step(20)
    simulation.reset()
    assert simulation.state_hash() == start
    np.testing.assert_allclose(crate.position, [0, 0, 1])
    assert "/Ramp" not in {thing.path for thing in simulation.objects}
