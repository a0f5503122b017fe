# SPDX-License-Identifier: BSD-3-Clause
"""The module `sim` as one child script sees it."""

from __future__ import annotations

from bubblesim.scripting.api import script_module
from bubblesim.scripting.joint_functions import JointFunctions
from bubblesim.scripting.object_functions import ObjectFunctions
from bubblesim.scripting.pack_functions import PackFunctions
from bubblesim.scripting.program_functions import ProgramFunctions
from bubblesim.scripting.random_functions import RandomFunctions
from bubblesim.scripting.sensor_functions import SensorFunctions
from bubblesim.scripting.signal_functions import SignalFunctions
from bubblesim.scripting.thread_functions import ThreadFunctions
from bubblesim.scripting.time_functions import TimeFunctions
from bubblesim.scripting.vision_functions import VisionFunctions


@script_module("sim")
class SimApi(
    ObjectFunctions,
    JointFunctions,
    SensorFunctions,
    VisionFunctions,
    SignalFunctions,
    PackFunctions,
    TimeFunctions,
    ThreadFunctions,
    RandomFunctions,
    ProgramFunctions,
):
    """All functions and constants, grouped by what they are about."""
