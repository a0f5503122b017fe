# SPDX-License-Identifier: BSD-3-Clause
"""An open robot simulator for ROS 1: robots, sensors and worlds that run without a display.

>>> import bubblesim
>>> simulation = bubblesim.Simulation("tricycle", seed=1)
>>> simulation.object("/FrontMotor").target_velocity = 1.0
>>> simulation.step(20)
>>> simulation.object("/Tricycle").position
"""

from bubblesim._core import (
    AltimeterReading,
    CameraImage,
    CollisionShape,
    Contact,
    ContactPoint,
    ContactReading,
    Diverged,
    ForceTorqueReading,
    ImuReading,
    LidarScan,
    MagnetometerReading,
    NavSatReading,
    NoSuchObject,
    Object,
    ProximityReading,
    SceneError,
    Simulation,
    scene_folders,
    scene_names,
)

__all__ = [
    "AltimeterReading",
    "CameraImage",
    "CollisionShape",
    "Contact",
    "ContactPoint",
    "ContactReading",
    "Diverged",
    "ForceTorqueReading",
    "ImuReading",
    "LidarScan",
    "MagnetometerReading",
    "NavSatReading",
    "NoSuchObject",
    "Object",
    "ProximityReading",
    "SceneError",
    "Simulation",
    "scene_folders",
    "scene_names",
]
