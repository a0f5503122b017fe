# SPDX-License-Identifier: BSD-3-Clause
"""All experiments, in the order of the table."""

from . import (
    fluids,
    friction,
    impacts,
    joints,
    long_motion,
    mechanisms,
    metamorphic,
    motion,
    rays_and_gps,
    robots,
    rotation,
    sensors,
    simbenchmark,
    stacks,
    supports,
    vehicles,
)

EXPERIMENTS = [
    *motion.EXPERIMENTS,
    *impacts.EXPERIMENTS,
    *friction.EXPERIMENTS,
    *vehicles.EXPERIMENTS,
    *supports.EXPERIMENTS,
    *stacks.EXPERIMENTS,
    *rotation.EXPERIMENTS,
    *joints.EXPERIMENTS,
    *long_motion.EXPERIMENTS,
    *mechanisms.EXPERIMENTS,
    *sensors.EXPERIMENTS,
    *fluids.EXPERIMENTS,
    *rays_and_gps.EXPERIMENTS,
    *simbenchmark.EXPERIMENTS,
    *robots.EXPERIMENTS,
    *metamorphic.EXPERIMENTS,
]
