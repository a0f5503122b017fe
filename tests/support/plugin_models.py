# SPDX-License-Identifier: BSD-3-Clause
"""Models with plugins, from wheels, links and joints, and how their odometry is received."""

from ros_peer import Message, Peer

RADIUS, TRACK, WHEELBASE = 0.1, 0.4, 0.5  # m
INERTIA = "<inertia><ixx>{0}</ixx><iyy>{0}</iyy><izz>{0}</izz></inertia>"


def link(name: str, x: float, y: float, z: float, mass: float, inertia: float, shape: str = "") -> str:
    collision = f'<collision name="shape"><geometry>{shape}</geometry></collision>' if shape else ""
    inertial = f"<inertial><mass>{mass}</mass>{INERTIA.format(inertia)}</inertial>"
    return f'<link name="{name}"><pose>{x} {y} {z} 0 0 0</pose>{inertial}{collision}</link>'


def joint(name: str, parent: str, child: str, axis: str, limit: float = 1e16) -> str:
    limits = f"<limit><lower>{-limit}</lower><upper>{limit}</upper></limit>"
    ends = f"<parent>{parent}</parent><child>{child}</child>"
    return f'<joint name="{name}" type="revolute">{ends}<axis><xyz>{axis}</xyz>{limits}</axis></joint>'


def wheel(name: str, x: float, y: float, parent: str = "body", radius: float = RADIUS) -> str:
    sphere = f"<sphere><radius>{radius}</radius></sphere>"
    return link(name, x, y, radius, 1, 0.004, sphere) + joint(f"{name}_joint", parent, name, "0 1 0")


def steered(name: str, x: float, y: float) -> str:
    """Return a wheel below a part that turns about the vertical."""
    knuckle = link(f"{name}_knuckle", x, y, RADIUS, 0.5, 0.002) + joint(
        f"{name}_steering", "body", f"{name}_knuckle", "0 0 1", 0.7
    )
    return knuckle + wheel(name, x, y, f"{name}_knuckle")


def robot(name: str, y: float, parts: str, plugin: str) -> str:
    body = link("body", WHEELBASE / 2, 0, 0.2, 5, 0.2, "<box><size>0.6 0.3 0.1</size></box>")
    return f'<model name="{name}"><pose>0 {y} 0 0 0 0</pose>{body}{parts}{plugin}</model>'


def plugin(filename: str, **parameters: str) -> str:
    elements = "".join(f"<{name}>{value}</{name}>" for name, value in parameters.items())
    return f'<plugin name="drive" filename="{filename}">{elements}</plugin>'


GROUND = (
    '<model name="floor"><static>true</static><link name="link">'
    '<collision name="c"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link></model>'
)


def world(*models: str) -> str:
    """Return a world with a floor and models."""
    return f'<sdf version="1.9"><world name="drives">{GROUND}{"".join(models)}</world></sdf>'


def moving(peer: Peer, topic: str, name: str, least: float) -> Message:
    """Return the odometry after a velocity has reached its value."""

    def fast(message: Message) -> bool:
        twist = message["twist"]["twist"]
        return abs(twist["linear"]["x"] if name == "x" else twist["angular"]["z"]) > least

    peer.wait_for(topic, "nav_msgs/Odometry", fast, f"{topic} to report motion")
    return peer.next(topic, count=5)


def velocity(message: Message) -> tuple[float, float]:
    twist = message["twist"]["twist"]
    return twist["linear"]["x"], twist["angular"]["z"]
