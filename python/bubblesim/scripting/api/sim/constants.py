# SPDX-License-Identifier: BSD-3-Clause
"""The constants of the `sim` module, with CoppeliaSim's values."""

from __future__ import annotations


class SimConstants:
    """Base class of the `sim` module."""

    handle_world = -1
    handle_all = -2
    handle_all_except_explicit = -3
    handle_self = -4
    handle_tree = -6
    handle_chain = -7
    handle_single = -8
    handle_parent = -11
    handle_scene = -12
    handleflag_resetforce = 0x400000
    handleflag_resettorque = 0x800000
    handleflag_resetforcetorque = 0xC00000
    handleflag_addmultiple = 0x0100000000000000

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
    verbosity_default = verbosity_loadinfos
    verbosity_undecorated = 0x0F000
    verbosity_onlyterminal = 0x10000
    verbosity_once = 0x20000

    drawing_points = 0
    drawing_lines = 1
    drawing_triangles = 2
    drawing_trianglepoints = 3
    drawing_quadpoints = 4
    drawing_discpoints = 5
    drawing_cubepoints = 6
    drawing_spherepoints = drawing_spherepts = 7
    drawing_linestrip = 8
    drawing_trianglepts = 9
    drawing_quadpts = 10
    drawing_discpts = 11
    drawing_cubepts = 12
    drawing_itemcolors = 0x20
    drawing_vertexcolors = 0x40
    drawing_itemsizes = 0x80
    drawing_backfaceculling = 0x100
    drawing_wireframe = 0x200
    drawing_painttag = 0x400
    drawing_followparentvisibility = 0x800
    drawing_cyclic = 0x1000
    drawing_50percenttransparency = 0x2000
    drawing_25percenttransparency = 0x4000
    drawing_12percenttransparency = 0x8000
    drawing_emissioncolor = 0x10000
    drawing_facingcamera = 0x20000
    drawing_overlay = 0x40000
    drawing_itemtransparency = 0x80000
    drawing_persistent = 0x100000
    drawing_auxchannelcolor1 = 0x200000
    drawing_auxchannelcolor2 = 0x400000
    drawing_local = 0x800000

    stream_transf_raw = 0
    stream_transf_derivative = 1
    stream_transf_integral = 2
    stream_transf_cumulative = 3

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

    jointintparam_motor_enabled = 2000
    jointfloatparam_velocity = 2012
    jointfloatparam_upper_limit = 2017

    object_shape_type = 0
    object_joint_type = 1
    object_graph_type = 2
    object_camera_type = 3
    object_dummy_type = 4
    object_proximitysensor_type = 5
    object_visionsensor_type = 9
    object_forcesensor_type = 12
    object_light_type = 13

    scripttype_main = 0
    scripttype_simulation = scripttype_childscript = 1

    colorcomponent_ambient = colorcomponent_ambient_diffuse = 0
    colorcomponent_diffuse = 1
    colorcomponent_specular = 2
    colorcomponent_emission = 3

    modelproperty_not_collidable = 0x1
    modelproperty_not_measurable = 0x2
    modelproperty_not_detectable = 0x8
    modelproperty_not_dynamic = 0x20
    modelproperty_not_respondable = 0x40
    modelproperty_not_reset = 0x80
    modelproperty_not_visible = 0x100
    modelproperty_scripts_inactive = 0x200
    modelproperty_not_model = 0xF000

    shapeintparam_static = 3003
    proxintparam_entity_to_detect = 4002
    shapeintparam_respondable = 3004
    primitiveshape_plane = 1
    primitiveshape_disc = 2
    primitiveshape_cuboid = 3
    primitiveshape_spheroid = 4
    primitiveshape_cylinder = 5
    primitiveshape_cone = 6
    primitiveshape_capsule = 7
    pure_primitive_plane = 1
    pure_primitive_disc = 2
    pure_primitive_cuboid = 3
    pure_primitive_spheroid = 4
    pure_primitive_cylinder = 5
    pure_primitive_cone = 6
    visionintparam_resolution_x = 1002
    visionintparam_resolution_y = 1003
    visionfloatparam_perspective_angle = 1004
    objfloatparam_abs_x_velocity = 11
    objfloatparam_abs_y_velocity = 12
    objfloatparam_abs_z_velocity = 13
    objfloatparam_abs_rot_velocity = 14

    boolparam_hierarchy_visible = 0
    boolparam_console_visible = 1
    boolparam_dynamics_handling_enabled = 6
    boolparam_proximity_sensor_handling_enabled = 9
    boolparam_vision_sensor_handling_enabled = 10
    boolparam_browser_visible = 12
    boolparam_shape_textures_are_visible = 15
    boolparam_display_enabled = 16
    boolparam_infotext_visible = 17
    boolparam_statustext_open = 18
    boolparam_fog_enabled = 19
    boolparam_mirrors_enabled = 22
    boolparam_realtime_simulation = 25
    boolparam_video_recording_triggered = 29
    boolparam_threaded_rendering_enabled = 32
    boolparam_fullscreen = 33
    boolparam_headless = 34

    intparam_program_version = 1
    intparam_current_page = 5
    intparam_dynamic_engine = 8
    intparam_visible_layers = 11
    intparam_platform = 19
    intparam_scene_unique_id = 20
    intparam_core_count = 24
    intparam_idle_fps = 26
    intparam_program_revision = 30
    intparam_scene_index = 34

    floatparam_rand = 0
    floatparam_simulation_time_step = 1

    stringparam_application_path = 0
    stringparam_scene_path_and_name = 13
    stringparam_scene_path = 15
    stringparam_scene_name = 16
    stringparam_verbosity = 121
    stringparam_statusbarverbosity = 122

    arrayparam_gravity = 0
    arrayparam_fog_color = 2
    arrayparam_background_color1 = 3
    arrayparam_background_color2 = 4
    arrayparam_ambient_light = 5
