# SPDX-License-Identifier: BSD-3-Clause
"""What the window's palette adds: shapes, lights, joints and sensors, as models in SDFormat."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from xml.sax.saxutils import escape

from bubblesim.scene_state.primitive_shapes import CAPSULE, CONE, CUBOID, CYLINDER, SPHEROID, PrimitiveShape

SHAPES = {"box": CUBOID, "sphere": SPHEROID, "cylinder": CYLINDER, "cone": CONE, "capsule": CAPSULE}


@dataclass(frozen=True)
class Material:
    """What a body is made of."""

    density: float
    """kg/m^3"""
    friction: float
    colour: tuple[float, float, float]


# Densities and dry friction: Engineering ToolBox; of two bodies the smaller coefficient counts.
MATERIALS = {
    "plastic": Material(1050, 0.35, (0.16, 0.45, 0.82)),
    "wood": Material(700, 0.5, (0.72, 0.53, 0.33)),
    "steel": Material(7850, 0.6, (0.62, 0.65, 0.69)),
    "rubber": Material(1100, 1.0, (0.17, 0.17, 0.19)),
    "ice": Material(917, 0.03, (0.78, 0.91, 0.97)),
}

_GREY = (0.25, 0.27, 0.3)
_LIGHTS = {
    "lamp": '<light name="light" type="point"><diffuse>1 0.95 0.85 1</diffuse><attenuation><range>8</range>'
    "<linear>0.3</linear><constant>0.3</constant></attenuation></light>",
    "spotlight": '<light name="light" type="spot"><diffuse>1 1 1 1</diffuse><direction>0 0 -1</direction>'
    "<cast_shadows>true</cast_shadows><attenuation><range>12</range><linear>0.05</linear><constant>0.3</constant>"
    "</attenuation><spot><inner_angle>0.6</inner_angle><outer_angle>1.1</outer_angle><falloff>1</falloff></spot>"
    "</light>",
}
_LIGHT_HEIGHT = 2.5  # m
_SENSORS = {
    "lidar": '<sensor name="Lidar" type="lidar"><update_rate>10</update_rate><lidar><scan><horizontal><samples>360'
    "</samples><min_angle>-3.14159</min_angle><max_angle>3.12414</max_angle></horizontal></scan><range><min>0.1</min>"
    "<max>10</max></range></lidar></sensor>",
    "camera": '<sensor name="Camera" type="camera"><update_rate>15</update_rate><camera><horizontal_fov>1.2'
    "</horizontal_fov><image><width>320</width><height>240</height></image><clip><near>0.05</near><far>30</far></clip>"
    "</camera></sensor>",
    "depth_camera": '<sensor name="DepthCamera" type="depth_camera"><update_rate>10</update_rate><camera>'
    "<horizontal_fov>1.2</horizontal_fov><image><width>160</width><height>120</height></image><clip><near>0.2</near>"
    "<far>8</far></clip></camera></sensor>",
    "sonar": '<sensor name="Sonar" type="sonar"><update_rate>20</update_rate><sonar><min>0.02</min><max>3</max>'
    "<radius>0.6</radius></sonar></sensor>",
    "imu": '<sensor name="Imu" type="imu"><update_rate>100</update_rate></sensor>',
}
_STAND = 0.3  # m, of a sensor that stands on the ground
_JOINTS = ("hinge", "slider")


@dataclass(frozen=True)
class Options:
    """How a part is to be. Only shapes have all of them."""

    size: Sequence[float] = (0.2, 0.2, 0.4)
    """Full lengths along x, y and z, m."""
    material: str = "plastic"
    fixed: bool = False
    """It stands still, whatever happens."""
    carrier: str = ""
    """Name of the link with which a sensor moves."""


def kinds() -> list[str]:
    """Return the kinds of parts."""
    return [*SHAPES, *_LIGHTS, *_JOINTS, *_SENSORS]


def is_sensor(kind: str) -> bool:
    """Return whether a part of this kind measures, and can be carried."""
    return kind in _SENSORS


def part(kind: str, name: str, options: Options) -> str:
    """Return a model of this kind, which stands on the ground at the origin, as SDFormat.

    :raises ValueError: for a kind or an option that is not known.
    """
    if options.material not in MATERIALS:
        raise ValueError(f"there is no material '{options.material}': there are {', '.join(MATERIALS)}")
    makers: tuple[tuple[Sequence[str], Callable[[str, str, Options], str]], ...] = (
        ([*SHAPES], _shape),
        ([*_LIGHTS], _light),
        (_JOINTS, _joint),
        ([*_SENSORS], _sensor),
    )
    for names, make in makers:
        if kind in names:
            content = make(kind, name, options)
            return (
                f'<sdf version="1.9" xmlns:bubblesim="https://bubblesim"><model name="{name}">{content}</model></sdf>'
            )
    raise ValueError(f"there is no part '{kind}': there are {', '.join(kinds())}")


def _shape(kind: str, name: str, options: Options) -> str:
    # Of a name of its own: sensors find the link that carries them by it.
    return (
        f"<static>{str(options.fixed).lower()}</static><pose>0 0 {options.size[2] / 2!r} 0 0 0</pose>"
        f'<link name="{name}">{_body(SHAPES[kind], options.size, options.material)}</link>'
    )


def _body(kind: int, size: Sequence[float], material: str) -> str:
    """Return inertia, collision and visual of a link that is one shape."""
    made_of = MATERIALS[material]
    shape = PrimitiveShape(kind, list(size))
    shape.mass = made_of.density * shape.volume
    xx, yy, zz = shape.inertia
    geometry = f"<geometry>{shape.geometry}</geometry>"
    mu = f"<mu>{made_of.friction}</mu><mu2>{made_of.friction}</mu2>"
    return (
        f"<inertial><mass>{shape.mass!r}</mass><inertia><ixx>{xx!r}</ixx><iyy>{yy!r}</iyy><izz>{zz!r}</izz></inertia>"
        f'</inertial><collision name="collision">{geometry}<surface><friction><ode>{mu}</ode></friction></surface>'
        f'</collision><visual name="visual">{geometry}{_colour(made_of.colour)}</visual>'
    )


def _colour(colour: Sequence[float], *, glows: bool = False) -> str:
    text = " ".join(map(str, colour))
    emissive = f"<emissive>{text} 1</emissive>" if glows else ""
    return f"<material><diffuse>{text} 1</diffuse>{emissive}</material>"


def _light(kind: str, name: str, _options: Options) -> str:
    bulb = (
        '<visual name="bulb"><cast_shadows>false</cast_shadows><geometry><sphere><radius>0.06</radius></sphere>'
        f"</geometry>{_colour((1, 0.96, 0.8), glows=True)}</visual>"
    )
    return (
        f'<static>true</static><pose>0 0 {_LIGHT_HEIGHT} 0 0 0</pose><link name="{name}">{_LIGHTS[kind]}{bulb}</link>'
    )


def _joint(kind: str, name: str, _options: Options) -> str:
    """Return a post on the ground with an arm that turns, or a rail with a carriage; the motor is a servo."""
    if kind == "hinge":
        post, arm, at = (0.1, 0.1, 0.5), (0.6, 0.06, 0.06), "0.3 0 0.53 0 0 0"
        joint, axis, limits = "revolute", "0 0 1", (-3.0, 3.0, 20.0, 3.0)
        origin = '<pose relative_to="__model__">0 0 0.53 0 0 0</pose>'
    else:
        post, arm, at = (1.2, 0.1, 0.06), (0.2, 0.2, 0.1), "0 0 0.11 0 0 0"
        joint, axis, limits = "prismatic", "1 0 0", (-0.5, 0.5, 200.0, 1.0)
        origin = ""
    lower, upper, effort, speed = limits
    return (
        f'<link name="{name}_base"><pose>0 0 {post[2] / 2} 0 0 0</pose>{_body(CUBOID, post, "steel")}</link>'
        f'<joint name="{name}_mount" type="fixed"><parent>world</parent><child>{name}_base</child></joint>'
        f'<link name="{name}_arm"><pose>{at}</pose>{_body(CUBOID, arm, "plastic")}</link>'
        f'<joint name="{name}" type="{joint}">{origin}<parent>{name}_base</parent><child>{name}_arm</child>'
        f"<axis><xyz>{axis}</xyz><limit><lower>{lower}</lower><upper>{upper}</upper><effort>{effort}</effort>"
        f"<velocity>{speed}</velocity></limit><bubblesim:motor>position</bubblesim:motor></axis></joint>"
    )


def _sensor(kind: str, name: str, options: Options) -> str:
    case = "<box><size>0.05 0.08 0.05</size></box>"
    if kind == "lidar":
        case = "<cylinder><radius>0.04</radius><length>0.05</length></cylinder>"
    below = (
        f'<visual name="post"><pose>0 0 {-_STAND / 2} 0 0 0</pose><geometry><cylinder><radius>0.015</radius>'
        f"<length>{_STAND}</length></cylinder></geometry>{_colour((0.6, 0.62, 0.65))}</visual>"
    )
    height = _STAND
    if options.carrier:
        below, height = f"<bubblesim:carrier>{escape(options.carrier)}</bubblesim:carrier>", 0.0
    return (
        f'<static>true</static><pose>0 0 {height} 0 0 0</pose><link name="{name}">'
        f'<visual name="case"><geometry>{case}</geometry>{_colour(_GREY)}</visual>{below}{_SENSORS[kind]}</link>'
    )
