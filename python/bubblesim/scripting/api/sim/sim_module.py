# SPDX-License-Identifier: BSD-3-Clause
"""The module `sim` of one child script."""

from __future__ import annotations

from bubblesim.scripting.api.functions import script_module
from bubblesim.scripting.api.sim.accepted_functions import AcceptedFunctions
from bubblesim.scripting.api.sim.added_scripts import AddedScriptFunctions
from bubblesim.scripting.api.sim.colours_and_textures import LookFunctions
from bubblesim.scripting.api.sim.configurations import ConfigurationFunctions
from bubblesim.scripting.api.sim.contacts import ContactFunctions
from bubblesim.scripting.api.sim.created_meshes import CreatedMeshFunctions
from bubblesim.scripting.api.sim.created_sensors import CreatedSensorFunctions
from bubblesim.scripting.api.sim.distances import DistanceFunctions
from bubblesim.scripting.api.sim.drawings import DrawingFunctions
from bubblesim.scripting.api.sim.forces import ForceFunctions
from bubblesim.scripting.api.sim.graphs import GraphFunctions
from bubblesim.scripting.api.sim.joints import JointFunctions
from bubblesim.scripting.api.sim.logs import LogFunctions
from bubblesim.scripting.api.sim.matrices import MatrixFunctions
from bubblesim.scripting.api.sim.messages import MessageFunctions
from bubblesim.scripting.api.sim.object_collections import CollectionFunctions
from bubblesim.scripting.api.sim.objects import ObjectFunctions
from bubblesim.scripting.api.sim.octrees import OctreeFunctions
from bubblesim.scripting.api.sim.old_functions import OldFunctions
from bubblesim.scripting.api.sim.old_kinematics import OldKinematicsFunctions
from bubblesim.scripting.api.sim.old_motion import OldMotionFunctions
from bubblesim.scripting.api.sim.old_user_interfaces import OldUserInterfaceFunctions
from bubblesim.scripting.api.sim.packing import PackFunctions
from bubblesim.scripting.api.sim.parameters import ParameterFunctions
from bubblesim.scripting.api.sim.particles import ParticleFunctions
from bubblesim.scripting.api.sim.paths import PathFunctions
from bubblesim.scripting.api.sim.programs import ProgramFunctions
from bubblesim.scripting.api.sim.properties import PropertyFunctions
from bubblesim.scripting.api.sim.random_numbers import RandomFunctions
from bubblesim.scripting.api.sim.referenced_handles import ReferencedHandleFunctions
from bubblesim.scripting.api.sim.scene_files import SceneFileFunctions
from bubblesim.scripting.api.sim.script_parameters import ScriptParameterFunctions
from bubblesim.scripting.api.sim.script_strings import ScriptStringFunctions
from bubblesim.scripting.api.sim.selection import SelectionFunctions
from bubblesim.scripting.api.sim.sensors import SensorFunctions
from bubblesim.scripting.api.sim.signals import SignalFunctions
from bubblesim.scripting.api.sim.simulator_functions import SimulatorFunctions
from bubblesim.scripting.api.sim.spherical_joints import SphericalJointFunctions
from bubblesim.scripting.api.sim.threads import ThreadFunctions
from bubblesim.scripting.api.sim.times import TimeFunctions
from bubblesim.scripting.api.sim.tubes import TubeFunctions
from bubblesim.scripting.api.sim.vision import VisionFunctions


@script_module("sim")
class SimApi(
    OldMotionFunctions,
    PathFunctions,
    ConfigurationFunctions,
    OldKinematicsFunctions,
    ObjectFunctions,
    SceneFileFunctions,
    OctreeFunctions,
    CreatedMeshFunctions,
    CreatedSensorFunctions,
    MatrixFunctions,
    ParameterFunctions,
    JointFunctions,
    SphericalJointFunctions,
    ForceFunctions,
    SensorFunctions,
    VisionFunctions,
    LookFunctions,
    ContactFunctions,
    DistanceFunctions,
    CollectionFunctions,
    PropertyFunctions,
    SignalFunctions,
    PackFunctions,
    TimeFunctions,
    ThreadFunctions,
    RandomFunctions,
    ParticleFunctions,
    DrawingFunctions,
    GraphFunctions,
    OldFunctions,
    AcceptedFunctions,
    ProgramFunctions,
    SimulatorFunctions,
    LogFunctions,
    ScriptStringFunctions,
    MessageFunctions,
    ReferencedHandleFunctions,
    AddedScriptFunctions,
    ScriptParameterFunctions,
    SelectionFunctions,
    TubeFunctions,
    OldUserInterfaceFunctions,
):
    """All functions and constants of `sim`."""
