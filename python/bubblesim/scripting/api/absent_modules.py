# SPDX-License-Identifier: BSD-3-Clause
"""The modules of CoppeliaSim that are not here, and what to use in their place."""

from __future__ import annotations

_INSTEAD = {
    "simAssimp": "sim.importShape reads .obj and .stl, scenes all common meshes",
    "simB0": "programs use the ZeroMQ remote API, or ROS",
    "simBubble": "the robot is a child script itself",
    "simCHAI3D": "there are no haptic devices",
    "simConvex": "scene files take meshes, which are made convex when they are loaded",
    "simEigen": "sim.multiplyMatrices, sim.multiplyPoses, and the module matrix",
    "simEvents": "callbacks sysCall_msg",
    "simGLTF": "scenes are written by sim.saveScene",
    "simGeom": "sim.checkCollision and sim.checkDistance",
    "simICP": "a Python script can use any library",
    "simIGL": "a Python script can use any library",
    "simMTB": "the robot is a child script itself",
    "simMujoco": "scene files have joints, motors and closed loops",
    "simOpenMesh": "scene files take meshes, which are simplified when they are loaded",
    "simPovRay": "cameras are rendered by ray casting",
    "simQHull": "scene files take meshes, which are made convex when they are loaded",
    "simQML": "simUI",
    "simRRS1": "the robot is a child script itself",
    "simSDF": "sim.loadModel takes .sdf files",
    "simSubprocess": "sim.launchExecutable",
    "simSurfRec": "a Python script can use any library",
    "simTest": "bubblesim test runs tests, sim.addLog writes lines",
    "simURDF": "scene files include .urdf files",
    "simWS": "programs use the ZeroMQ remote API, or ROS",
    "simZMQ": "programs use the ZeroMQ remote API, or ROS",
}
ABSENT = {
    name: f"CoppeliaSim's module {name} is not here: {instead} (docs/coming_from_coppeliasim.md)"
    for name, instead in _INSTEAD.items()
}
