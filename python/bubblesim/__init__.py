# SPDX-License-Identifier: BSD-3-Clause
"""An open robot simulator for ROS 1 and ROS 2: robots, sensors and worlds that run without a display.

>>> import bubblesim
>>> simulation = bubblesim.Simulation("tricycle", seed=1)
>>> simulation.object("/FrontMotor").target_velocity = 1.0
>>> simulation.step(20)
>>> simulation.object("/Tricycle").position
"""

from __future__ import annotations

import importlib
import sys
from pkgutil import extend_path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    __version__: str
    from bubblesim._core import (
        AirPressureReading,
        AltimeterReading,
        Batch,
        Buoyancy,
        CameraImage,
        CollisionShape,
        Contact,
        ContactPoint,
        ContactReading,
        Distribution,
        Diverged,
        Drag,
        ForceTorqueReading,
        Frame,
        Grasp,
        ImuReading,
        LidarScan,
        LiftDrag,
        LogicalCameraReading,
        MagnetometerReading,
        MotorMode,
        MulticopterVelocityControl,
        NavSatReading,
        NoSuchObject,
        NotCarriedOut,
        Object,
        ProximityReading,
        Quantity,
        Rotor,
        Runner,
        RunState,
        Scene,
        SceneError,
        Simulation,
        WheelSlip,
        Wind,
        WrongObject,
        scene_folders,
        scene_names,
    )
    from bubblesim.remote.connection import connect

__all__ = [
    "AirPressureReading",
    "AltimeterReading",
    "Batch",
    "Buoyancy",
    "CameraImage",
    "CollisionShape",
    "Contact",
    "ContactPoint",
    "ContactReading",
    "Distribution",
    "Diverged",
    "Drag",
    "ForceTorqueReading",
    "Frame",
    "Grasp",
    "ImuReading",
    "LidarScan",
    "LiftDrag",
    "LogicalCameraReading",
    "MagnetometerReading",
    "MotorMode",
    "MulticopterVelocityControl",
    "NavSatReading",
    "NoSuchObject",
    "NotCarriedOut",
    "Object",
    "ProximityReading",
    "Quantity",
    "Rotor",
    "RunState",
    "Runner",
    "Scene",
    "SceneError",
    "Simulation",
    "WheelSlip",
    "Wind",
    "WrongObject",
    "connect",
    "scene_folders",
    "scene_names",
]

# In a development space, the compiled module is in another folder of the path: spawned processes need it too.
__path__ = extend_path(__path__, __name__)


def _why_not_loaded() -> str:
    """Return why the compiled module is not found: it is for one version of Python, and may not be built at all."""
    from pathlib import Path

    here = f"{sys.version_info.major}.{sys.version_info.minor}"
    for folder in __path__:
        for file in Path(folder).glob("_core.cpython-*.so"):
            digits = file.name.split("-")[1]
            return (
                f"bubblesim was built for Python {digits[0]}.{digits[1:]}, this is {here} ({sys.executable}): "
                "use /usr/bin/python3"
            )
    return "the compiled part of bubblesim is not found: run scripts/setup, and source .ws/devel/setup.bash"


def __getattr__(name: str) -> Any:
    """Load the core on first use: some commands of `bubblesim` do not need it, and loading takes 0.1 s."""
    if name == "_core":
        try:
            return importlib.import_module("bubblesim._core")
        except ModuleNotFoundError as error:
            if error.name == "bubblesim._core":
                raise ImportError(_why_not_loaded()) from None
            raise
    # Kinds of sensors that were added have classes with this ending.
    if name not in (*__all__, "__version__") and not name.endswith("Reading"):
        import difflib

        from bubblesim.messages.names import did_you_mean, unknown_attribute

        near = did_you_mean([f"bubblesim.{known}" for known in difflib.get_close_matches(name, __all__, n=1)])
        raise unknown_attribute(f"module 'bubblesim' has no attribute {name!r}{near}")
    if name == "connect":
        from bubblesim.remote.connection import connect

        return connect
    from bubblesim import _core

    if not hasattr(_core, name):
        raise AttributeError(f"module 'bubblesim' has no attribute {name!r}")
    return getattr(_core, name)
