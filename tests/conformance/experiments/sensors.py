# SPDX-License-Identifier: BSD-3-Clause
"""Sensors of moving bodies: IMU, forces, and the times of readings. Only bubblesim has these sensors."""

from __future__ import annotations

from typing import Any

import numpy as np

from .experiment import Experiment, Tolerance, product_of
from .geodesy import to_local
from .scene import GRAVITY, Body, Joint, Model, Scene, Shape, box, box_inertia, sphere_inertia

RADIUS, RATE = 0.5, 10.0  # m, rad/s


def turntable() -> Model:
    """Return an arm that turns about z, with an IMU and, behind a force-torque sensor, a kilogram at its end."""
    imu = f'<sensor name="imu" type="imu"><pose>{RADIUS} 0 0 0 0 0</pose></sensor>'
    wrist = '<sensor name="wrist" type="force_torque"/>'
    arm = Body("arm", 5.0, box_inertia(5.0, (1.0, 0.1, 0.1)), sensors=imu)
    tip = Body("tip", 1.0, sphere_inertia(1.0, 0.05), position=(RADIUS, 0, 0))
    joints = (
        Joint("hub", "revolute", "world", "arm", motor="velocity", effort=1e5),
        Joint("mount", "fixed", "arm", "tip", anchor=(RADIUS, 0, 0), sensors=wrist),
    )
    return Model("table", (arm, tip), joints, (0, 0, 1))


def turning_theory(quantity: str) -> float:
    """An IMU at radius r measures a - g = (-w^2 r, 0, g) in its own axes (REP 145); a mass m pulls with m w^2 r."""
    return {
        "imu x": -(RATE**2) * RADIUS,
        "imu y": 0.0,
        "imu z": GRAVITY,
        "rate z": RATE,
        "force x": RATE**2 * RADIUS,
        "force y": 0.0,
        "force z": -GRAVITY,
        "torque z": 0.0,
    }[quantity]


def turning(engine: Any, quantity: str) -> float:
    """Return a reading after a second at 10 rad/s, with simulation steps of 50 ms."""
    world = engine(Scene((turntable(),), substeps=10, ground=False))
    world.set_target("hub", RATE)
    world.run(1.0)
    imu = world.simulation.object("/table/arm/imu").reading
    wrist = world.simulation.object("/wrist").reading
    values = {"imu": imu.linear_acceleration, "rate": imu.angular_velocity}
    values |= {"force": wrist.force, "torque": wrist.torque}
    name, axis = quantity.split()
    return float(values[name]["xyz".index(axis)])


def weight_theory(quantity: str) -> float:
    """The impulse of the ground is m (g T + v0 - v) (Newton); forces between two bodies are opposite."""
    return 2.0 * GRAVITY * 3.0 if quantity == "impulse of an impact" else 0.0


def weighing(engine: Any, quantity: str) -> float:
    """Drop 2 kg onto a body on the ground; return the impulse on it in 3 s, N s, or the sum of both forces, N."""

    def cube(name: str, size: float, height: float, mass: float) -> Model:
        shape = (Shape("box", (size, size, size)),)
        inertia = box_inertia(mass, (size, size, size))
        sensor = f'<sensor name="{name}_touch" type="contact"/>'
        return Model(name, (Body(name, mass, inertia, shape, sensors=sensor),), position=(0, 0, height))

    world = engine(Scene((cube("lower", 0.4, 0.2, 8.0), cube("upper", 0.2, 0.8, 2.0)), substeps=10))
    impulse, sums = 0.0, 0.0
    for _ in range(60):
        world.run(0.05)
        up = world.simulation.object("/upper_touch").reading.contacts
        down = [
            c
            for c in world.simulation.object("/lower_touch").reading.contacts
            if c.other == world.links["upper"].handle
        ]
        force = sum((np.array(c.force) for c in up), np.zeros(3))
        impulse += 0.05 * float(force[2])
        sums = max(sums, float(np.linalg.norm(force + sum((np.array(c.force) for c in down), np.zeros(3)))))
    return impulse if quantity == "impulse of an impact" else sums


SPEED, WALL = 10.0, 60.0  # m/s, m
ORIGIN = (48.1, 11.6, 500.0)  # degrees, degrees, m


def stamp_theory(sensor: str, rate: float, step: float) -> float:
    """A body at constant speed is at v t: a reading shows the state of its stamp."""
    return 0.0


def stamps(engine: Any, sensor: str, rate: float, step: float) -> float:
    """Return the greatest difference between a stamp and the time at which the body was where the reading has it, s."""
    forms = {
        "gps": f'<sensor name="probe" type="navsat"><update_rate>{rate}</update_rate></sensor>',
        "lidar": f"""<sensor name="probe" type="lidar"><update_rate>{rate}</update_rate><lidar><scan><horizontal>
            <samples>1</samples><min_angle>0</min_angle><max_angle>0</max_angle></horizontal></scan>
            <range><min>0.2</min><max>100</max></range></lidar></sensor>""",
        "sonar": f"""<sensor name="probe" type="sonar"><update_rate>{rate}</update_rate><sonar><min>0.2</min>
            <max>100</max><radius>0.1</radius><bubblesim:volume>ray</bubblesim:volume></sonar></sensor>""",
    }
    body = Body("mover", 1.0, box_inertia(1.0, (0.2, 0.2, 0.2)), sensors=forms[sensor])
    wall = box("wall", (1, 4, 4), (WALL + 0.5, 0, 1), static=True)
    place = f"""<spherical_coordinates><surface_model>EARTH_WGS84</surface_model>
        <latitude_deg>{ORIGIN[0]}</latitude_deg><longitude_deg>{ORIGIN[1]}</longitude_deg><elevation>{ORIGIN[2]}</elevation></spherical_coordinates>"""
    scene = Scene(
        (Model("mover", (body,), position=(0, 0, 1)), wall),
        step=step / 10,
        substeps=10,
        gravity=(0, 0, 0),
        ground=False,
        world=place,
    )
    world = engine(scene)
    world.set_velocity("mover", (SPEED, 0, 0))
    probe = world.simulation.object("/mover/mover/probe")
    worst = 0.0
    for _ in range(round(4 / step)):
        world.run(step)
        reading = probe.reading
        time = float(reading_time(world.simulation, probe))
        if time == 0:
            continue  # not due yet
        if sensor == "gps":
            x = to_local(reading.latitude, reading.longitude, reading.altitude, ORIGIN)[0]
        else:
            x = WALL - float(reading.ranges[0, 0] if sensor == "lidar" else reading.distance)
        worst = max(worst, abs(x / SPEED - time))
    return worst


def reading_time(simulation: Any, sensor: Any) -> float:
    """Return the stamp of a sensor's last reading."""
    from bubblesim import _core

    return float(_core.read_sensor(simulation, sensor.handle)[0])


EXPERIMENTS = [
    Experiment(
        "turning_sensors",
        "IMU and force-torque sensor 0.5 m off the axis, 10 rad/s, step 50 ms",
        "m/s^2, N",
        turning_theory,
        turning,
        Tolerance("2 % of 50: the direction of the last substep is 2.9 degrees wide", absolute=1.0),
        product_of(
            quantity=("imu x", "imu y", "imu z", "rate z", "force x", "force y", "force z", "torque z"),
        ),
        peers=(),
    ),
    Experiment(
        "contact_sensor",
        "Contact sensors in an impact",
        "N s, N",
        weight_theory,
        weighing,
        Tolerance("the rest of the velocity after 3 s: 1e-3 of the impulse", absolute=0.06),
        product_of(quantity=("impulse of an impact", "sum of both forces")),
        peers=(),
    ),
    Experiment(
        "stamps",
        "Readings of a body at 10 m/s, stamp against state",
        "s",
        stamp_theory,
        stamps,
        Tolerance("ranges of 60 m in single precision: 4e-6 m", absolute=1e-6),
        product_of(sensor=("gps", "lidar", "sonar"), rate=(20.0, 10.0, 7.0), step=(0.05, 0.048)),
        peers=(),
    ),
]
