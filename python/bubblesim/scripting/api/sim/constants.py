# SPDX-License-Identifier: BSD-3-Clause
"""The constants of the `sim` module, with CoppeliaSim's values."""

from __future__ import annotations


class SimConstants:
    """Base class of the `sim` module."""

    handle_world = -1
    handle_all = -2
    handle_all_except_explicit = -3
    handle_self = -4
    handle_parent = -11
    handle_scene = -12
    handleflag_resetforce = 0x400000
    handleflag_resettorque = 0x800000
    handleflag_resetforcetorque = 0xC00000

    simulation_stopped = 0
    simulation_paused = 8
    simulation_advancing_running = 0x11
    simulation_advancing_lastbeforestop = 0x16

    verbosity_none = 100
    verbosity_errors = 200
    verbosity_warnings = 300
    verbosity_loadinfos = 400
    verbosity_scripterrors = 420
    verbosity_scriptwarnings = 430
    verbosity_scriptinfos = 450
    verbosity_msgs = 450
    verbosity_infos = 500
    verbosity_debug = 600
    verbosity_trace = 700

    joint_revolute = joint_revolute_subtype = 10
    joint_prismatic = joint_prismatic_subtype = 11
    joint_spherical = joint_spherical_subtype = 12
    jointmode_passive = jointmode_kinematic = 0
    jointmode_dependent = 3
    jointmode_force = jointmode_dynamic = 5
    jointintparam_dynctrlmode = 2039
    jointdynctrl_free = 0
    jointdynctrl_force = 1
    jointdynctrl_velocity = 4
    jointdynctrl_position = 8

    object_shape_type = 0
    object_joint_type = 1
    object_dummy_type = 4
    object_proximitysensor_type = 5
    object_visionsensor_type = 9
    object_forcesensor_type = 12
