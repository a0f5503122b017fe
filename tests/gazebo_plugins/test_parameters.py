# SPDX-License-Identifier: BSD-3-Clause
"""Parameters that plugins read from <plugin> elements."""

import math

import pytest

import bubblesim
from bubblesim.gazebo_plugins.parameters import ParameterError, Parameters
from bubblesim.gazebo_plugins.registry import library

MODEL = """\
<sdf version="1.9">
  <model name="any">
    <plugin name="p" filename="libp.so">
      <wheelSeparation> 0.5 </wheelSeparation>
      <wheel_radius>0.1</wheel_radius>
      <often>1e400</often>
      <none>-1</none>
      <enabled>1</enabled>
      <disabled>False</disabled>
      <offset>1 2 3</offset>
      <joint>a</joint>
      <joint>b, c</joint>
      <source>wheels</source>
      <ros><namespace>/robot</namespace></ros>
      <wheel_diameter>0.2</wheel_diameter>
      <wheel_diameter>0.1</wheel_diameter>
      <wheel_diameter>wide</wheel_diameter>
    </plugin>
    <link name="link"/>
  </model>
</sdf>
"""


@pytest.fixture
def parameters() -> Parameters:
    simulation = bubblesim.Simulation("ball")
    model = simulation.add_model(MODEL)
    (plugin,) = simulation.world.plugins(model.handle)
    return Parameters(plugin)


def test_values_have_types_and_both_spellings_and_defaults(parameters: Parameters) -> None:
    assert parameters.number("wheelSeparation", 1.0) == 0.5
    assert parameters.number("wheelRadius", 1.0) == 0.1
    assert parameters.number("torque", 5.0) == 5.0
    assert parameters.number("none", 1.0) == -1.0
    assert (parameters.flag("enabled", default=False), parameters.flag("disabled", default=True)) == (True, False)
    assert parameters.numbers("offset", (0.0, 0.0, 0.0)) == (1.0, 2.0, 3.0)
    assert parameters.names("joint") == ["a", "b", "c"]
    assert parameters.text("missing", "default") == "default"
    assert parameters.child("ros", "namespace") == "/robot"
    parameters.check()


def test_several_elements_of_a_name_have_a_length_each(parameters: Parameters) -> None:
    assert parameters.lengths("wheelDiameter", 1.0, 2) == [0.2, 0.1]
    assert parameters.lengths("wheelSeparation", 1.0, 3) == [0.5, 0.5, 0.5], "the last one counts for the rest"
    assert parameters.lengths("missing", 1.0, 2) == [1.0, 1.0]
    parameters.check()
    parameters.lengths("wheelDiameter", 1.0, 3)
    with pytest.raises(ParameterError, match=":17: plugin 'p': <wheelDiameter> is 'wide', it must be a number above 0"):
        parameters.check()


def test_deviations_are_one_or_three(parameters: Parameters) -> None:
    assert parameters.deviations("wheelSeparation") == (0.5,)
    assert parameters.deviations("offset") == (1.0, 2.0, 3.0)
    assert parameters.deviations("missing") == (0.0,)
    parameters.check()
    parameters.deviations("none")
    with pytest.raises(ParameterError, match=r"one or three numbers \(x, y and z\) of at least 0"):
        parameters.check()


def test_all_that_is_wrong_is_reported_at_once_with_its_line(parameters: Parameters) -> None:
    assert parameters.number("often", 2.0) == 2.0
    assert parameters.length("none", 3.0) == 3.0
    assert parameters.choice("source", "world", {"world": 1, "encoder": 2}) == 1
    assert parameters.numbers("offset", (0.0, 0.0)) == (0.0, 0.0)
    with pytest.raises(ParameterError) as caught:
        parameters.check()
    assert str(caught.value).splitlines() == [
        "<data-string>:6: plugin 'p': <often> is '1e400', it must be a number",
        "<data-string>:7: plugin 'p': <none> is '-1', it must be a number above 0",
        "<data-string>:13: plugin 'p': <source> is 'wheels', it must be world or encoder",
        "<data-string>:10: plugin 'p': <offset> is '1 2 3', it must be 2 numbers",
    ]


def test_what_nobody_asked_for_is_named(parameters: Parameters) -> None:
    parameters.number("wheelSeparation", 1.0)
    parameters.names("joint")
    parameters.flag("enable", default=True)
    for known in ("often", "none", "offset", "ros", "source", "disabled", "wheel_diameter"):
        parameters.ignore(known)
    assert sorted(parameters.unused()) == ["enabled; did you mean enable?", "wheel_radius"]


def test_a_least_value_is_reported(parameters: Parameters) -> None:
    assert parameters.number("none", math.inf, least=0.0) == math.inf
    with pytest.raises(ParameterError, match="must be a number of at least 0"):
        parameters.check()


@pytest.mark.parametrize(
    ("filename", "name"),
    [
        ("libgazebo_ros_laser.so", "gazebo_ros_laser"),
        ("gazebo_ros_laser", "gazebo_ros_laser"),
        ("/opt/lib/libgazebo_ros_laser.so", "gazebo_ros_laser"),
        ("ignition-gazebo-diff-drive-system", "gz-diff-drive-system"),
        ("libignition-gazebo6-diff-drive-system.so", "gz-diff-drive-system"),
        ("gz-sim-diff-drive-system", "gz-diff-drive-system"),
        ("libgz-sim8-diff-drive-system.so", "gz-diff-drive-system"),
    ],
)
def test_a_library_is_known_under_its_names_of_all_systems(filename: str, name: str) -> None:
    assert library(filename) == name
