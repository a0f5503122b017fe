# SPDX-License-Identifier: BSD-3-Clause
"""Substeps for which ODE's exact solver finds no solution: another solver takes them."""

from pathlib import Path

import numpy as np

from bubblesim import Simulation

SURFACE = """<surface>
  <contact><ode><kp>1e5</kp><kd>100</kd><min_depth>0.001</min_depth><max_vel>100</max_vel></ode></contact>
  <friction><torsional><coefficient>1</coefficient><use_patch_radius>0</use_patch_radius>
    <surface_radius>0.01</surface_radius></torsional></friction>
</surface>"""


def box(name: str, place: str, size: str) -> str:
    return (
        f'<collision name="{name}"><pose>{place} 0 0 0</pose><geometry><box><size>{size}</size></box></geometry>'
        f"{SURFACE}</collision>"
    )


# A case on two feet, and its open lid, which lies on the ground: twelve contact points with torsional friction, of
# which a few carry all and the others next to nothing.
SCENE = f"""\
<sdf version="1.6"><world name="w">
  <model name="ground"><static>true</static><link name="link">
    <collision name="c"><geometry><plane/></geometry></collision>
  </link></model>
  <model name="case">
    <link name="base"><pose>0 0 0.02 0 0 0</pose>
      <inertial><pose>-0.02 0 0.17 0 0 0</pose><mass>4</mass>
        <inertia><ixx>0.2</ixx><iyy>0.07</iyy><izz>0.15</izz></inertia></inertial>
      {box("left", "0.01 0.215 -0.012", "0.11 0.05 0.024")}
      {box("right", "0.01 -0.215 -0.012", "0.11 0.05 0.024")}
    </link>
    <link name="lid"><pose>0.24 0 0 0 0 0</pose>
      <inertial><mass>2</mass><inertia><ixx>0.05</ixx><iyy>0.02</iyy><izz>0.07</izz></inertia></inertial>
      {box("plate", "0 0 0.01", "0.356 0.584 0.02")}
    </link>
    <joint name="hinge" type="revolute"><pose>-0.178 0 0.019 0 0 0</pose><parent>base</parent><child>lid</child>
      <axis><xyz>0 1 0</xyz><limit><lower>-1.57</lower><upper>0.52</upper></limit></axis></joint>
  </model>
</world></sdf>
"""


def test_they_do_not_throw_bodies_at_rest_about(tmp_path: Path) -> None:
    file = tmp_path / "case.sdf"
    file.write_text(SCENE)
    simulation = Simulation(str(file))
    simulation.step(20)
    lid = simulation.object("/case/lid")
    fastest = 0.0
    for _ in range(400):
        simulation.step()
        fastest = max(fastest, float(np.linalg.norm(lid.angular_velocity)))
    # A substep without any contact force would give the lid, held at its hinge, about g h / 0.2 m = 0.2 rad/s.
    assert fastest < 1e-3
