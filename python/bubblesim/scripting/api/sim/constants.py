# SPDX-License-Identifier: BSD-3-Clause
"""The constants of the `sim` module, with CoppeliaSim's values."""

from __future__ import annotations

from bubblesim.scripting.api.sim.parameter_constants import ParameterConstants
from bubblesim.scripting.api.sim.version_constants import VersionConstants


class SimConstants(VersionConstants, ParameterConstants):
    """Base class of the `sim` module."""

    handle_world = -1
    handle_all = -2
    handle_all_except_explicit = -3
    handle_self = -4
    handle_main_script = -5
    handle_tree = -6
    handle_chain = -7
    handle_single = -8
    handle_default = -9
    handle_all_except_self = -10
    handle_parent = -11
    handle_scene = -12
    handle_app = -13
    handleflag_assembly = handleflag_togglevisibility = handleflag_extended = handleflag_greyscale = 0x400000
    handleflag_codedstring = handleflag_wxyzquat = handleflag_wxyzquaternion = handleflag_reljointbaseframe = 0x400000
    handleflag_keeporiginal = handleflag_camera = handleflag_altname = handleflag_axis = 0x400000
    handleflag_abscoords = handleflag_depthbuffer = handleflag_depthbuffermeters = handleflag_model = 0x800000
    handleflag_rawvalue = 0x1000000
    handleflag_silenterror = 0x2000000
    handleflag_resetforce = 0x400000
    handleflag_resettorque = 0x800000
    handleflag_resetforcetorque = 0xC00000
    handleflag_addmultiple = 0x0100000000000000

    simulation_stopped = 0
    simulation_paused = 8
    simulation_advancing = simulation_advancing_firstafterstop = 0x10
    simulation_advancing_running = 0x11
    simulation_advancing_lastbeforepause = 0x13
    simulation_advancing_firstafterpause = 0x14
    simulation_advancing_abouttostop = 0x15
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
    jointmode_motion_deprecated = 1
    jointmode_ik = jointmode_ik_deprecated = 2
    jointmode_dependent = 4
    jointmode_force = jointmode_dynamic = 5
    jointdynctrl_free = 0
    jointdynctrl_force = 1
    jointdynctrl_velocity = 4
    jointdynctrl_position = 8
    jointdynctrl_callback = 16

    object_shape_type = 0
    object_joint_type = 1
    object_graph_type = 2
    object_camera_type = 3
    object_dummy_type = 4
    object_proximitysensor_type = 5
    object_path_type = 8
    object_visionsensor_type = 9
    object_mill_type = 11
    object_forcesensor_type = 12
    object_light_type = 13
    object_mirror_type = 14
    object_octree_type = 15
    object_pointcloud_type = 16
    object_script_type = 17
    appobj_object_type = 109
    appobj_collision_type = 110
    appobj_distance_type = 111
    appobj_simulation_type = 112
    appobj_ik_type = 113
    appobj_collection_type = 115
    appobj_ui_type = 116
    appobj_script_type = 117
    appobj_pathplanning_type = 118
    appobj_texture_type = 120

    scripttype_main = scripttype_mainscript = 0
    scripttype_simulation = scripttype_childscript = 1
    scripttype_addon = scripttype_addonscript = 2
    scripttype_customization = scripttype_customizationscript = 6
    scripttype_sandbox = scripttype_sandboxscript = 8
    scripttype_threaded = scripttype_threaded_old = 0xF0
    scriptattribute_executionorder = 1
    scriptattribute_executioncount = 2
    scriptattribute_enabled = childscriptattribute_enabled = 4
    childscriptattribute_automaticcascadingcalls = 3
    customizationscriptattribute_activeduringsimulation = 0
    childscriptcall_initialization = 0
    childscriptcall_actuation = 1
    childscriptcall_sensing = 2
    childscriptcall_cleanup = 3
    scriptthreadresume_launch = -2
    scriptthreadresume_allnotyetresumed = -1
    scriptthreadresume_default = 0
    scriptthreadresume_actuation_first = 1
    scriptthreadresume_actuation_last = 2
    scriptthreadresume_sensing_first = 3
    scriptthreadresume_sensing_last = 4
    scriptthreadresume_custom = 5
    script_no_error = 0
    script_main_script_nonexistent = 1
    script_main_script_not_called = 2
    script_reentrance_error = 4
    script_lua_error = 8
    script_call_error = 16

    colorcomponent_ambient = colorcomponent_ambient_diffuse = 0
    colorcomponent_diffuse = 1
    colorcomponent_specular = 2
    colorcomponent_emission = 3
    colorcomponent_transparency = 4
    colorcomponent_auxiliary = 5

    modelproperty_not_collidable = 0x1
    modelproperty_not_measurable = 0x2
    modelproperty_not_renderable = 0x4
    modelproperty_not_detectable = 0x8
    modelproperty_not_dynamic = 0x20
    modelproperty_not_respondable = 0x40
    modelproperty_not_reset = 0x80
    modelproperty_not_visible = 0x100
    modelproperty_scripts_inactive = 0x200
    modelproperty_not_showasinsidemodel = 0x400
    modelproperty_not_model = 0xF000

    primitiveshape_plane = 1
    primitiveshape_disc = 2
    primitiveshape_cuboid = 3
    primitiveshape_spheroid = 4
    primitiveshape_cylinder = 5
    primitiveshape_cone = 6
    primitiveshape_heightfield = 7
    primitiveshape_capsule = 8
    primitiveshape_none = 0
    pure_primitive_plane = 1
    pure_primitive_disc = 2
    pure_primitive_cuboid = 3
    pure_primitive_spheroid = 4
    pure_primitive_cylinder = 5
    pure_primitive_cone = 6
    pure_primitive_none = 0
    pure_primitive_heightfield = 7

    shape_simple_subtype = shape_simpleshape_subtype = 20
    shape_compound_subtype = shape_multishape_subtype = 21
    proximitysensor_pyramid_subtype = 30
    proximitysensor_cylinder_subtype = 31
    proximitysensor_disc_subtype = 32
    proximitysensor_cone_subtype = 33
    proximitysensor_ray_subtype = 34
    light_omnidirectional_subtype = 1
    light_spot_subtype = 2
    light_directional_subtype = 3
    object_no_subtype = 200

    objectspecialproperty_collidable = 0x1
    objectspecialproperty_measurable = 0x2
    objectspecialproperty_detectable_ultrasonic = 0x10
    objectspecialproperty_detectable_infrared = 0x20
    objectspecialproperty_detectable_laser = 0x40
    objectspecialproperty_detectable_inductive = 0x80
    objectspecialproperty_detectable_capacitive = 0x100
    objectspecialproperty_detectable = objectspecialproperty_detectable_all = 0x1F0
    objectspecialproperty_renderable = 0x200
    objectspecialproperty_pathplanning_ignored = 0x800
    objectproperty_collapsed = 0x10
    objectproperty_selectable = 0x20
    objectproperty_selectmodelbaseinstead = 0x80
    objectproperty_dontshowasinsidemodel = 0x100
    objectproperty_canupdatedna = 0x400
    objectproperty_selectinvisible = 0x800
    objectproperty_depthinvisible = 0x1000
    objectproperty_cannotdelete = 0x2000
    objectproperty_cannotdeleteduringsim = 0x4000

    dlgstyle_message = 0
    dlgstyle_input = 1
    dlgstyle_ok = 2
    dlgstyle_ok_cancel = 3
    dlgstyle_yes_no = 4
    dlgstyle_dont_center = 32
    dlgret_still_open = 0
    dlgret_ok = 1
    dlgret_cancel = 2
    dlgret_yes = 3
    dlgret_no = 4
    msgbox_type_info = 0
    msgbox_type_question = 1
    msgbox_type_warning = 2
    msgbox_type_critical = 3
    msgbox_buttons_ok = 0
    msgbox_buttons_yesno = 1
    msgbox_buttons_yesnocancel = 2
    msgbox_buttons_okcancel = 3
    msgbox_return_cancel = 0
    msgbox_return_no = 1
    msgbox_return_yes = 2
    msgbox_return_ok = 3
    msgbox_return_error = 4
    filedlg_type_load = 0
    filedlg_type_save = 1
    filedlg_type_load_multiple = 2
    filedlg_type_folder = 3

    ui_property_visible = 1
    ui_property_visibleduringsimulationonly = 2
    ui_property_moveable = 4
    buttonproperty_button = 0
    buttonproperty_label = 1
    buttonproperty_slider = 2
    buttonproperty_editbox = 3
    buttonproperty_staydown = 8
    buttonproperty_enabled = 16
    buttonproperty_borderless = 32
    buttonproperty_horizontallycentered = 64
    buttonproperty_ignoremouse = 128
    buttonproperty_isdown = 256
    buttonproperty_transparent = 512
    buttonproperty_nobackgroundcolor = 1024
    buttonproperty_rollupaction = 2048
    buttonproperty_closeaction = 4096
    buttonproperty_verticallycentered = 8192
    buttonproperty_downupevent = 16384

    message_ui_button_state_change = 0
    message_object_selection_changed = 2
    message_model_loaded = 4
    message_keypress = 6
    message_bannerclicked = 7
    message_scene_loaded = 8

    particle_points1 = 0
    particle_points2 = 1
    particle_points4 = 2
    particle_roughspheres = 3
    particle_spheres = 4
    particle_respondable1to4 = 0x20
    particle_respondable5to8 = 0x40
    particle_particlerespondable = 0x80
    particle_ignoresgravity = 0x100
    particle_invisible = 0x200
    particle_itemsizes = 0x400
    particle_itemdensities = 0x800
    particle_itemcolors = 0x1000
    particle_cyclic = 0x2000
    particle_emissioncolor = 0x4000
    particle_water = 0x8000
    particle_painttag = 0x10000

    dummy_linktype_dynamics_loop_closure = dummylink_dynloopclosure = 0
    dummy_linktype_dynamics_force_constraint = dummylink_dyntendon = 1
    dummy_linktype_gcs_loop_closure = 2
    dummy_linktype_gcs_tip = 3
    dummy_linktype_gcs_target = 4
    dummy_linktype_ik_tip_target = 5

    ik_pseudo_inverse_method = 0
    ik_damped_least_squares_method = 1
    ik_jacobian_transpose_method = 2
    ik_x_constraint = 1
    ik_y_constraint = 2
    ik_z_constraint = 4
    ik_alpha_beta_constraint = 8
    ik_gamma_constraint = 16
    ikresult_not_performed = 0
    ikresult_success = 1
    ikresult_fail = 2

    rml_phase_sync_if_possible = ruckig_phasesync = 0
    rml_only_time_sync = ruckig_timesync = 1
    rml_only_phase_sync = 2
    rml_no_sync = ruckig_nosync = 3
    rml_keep_target_vel = 0
    rml_recompute_trajectory = 4
    rml_disable_extremum_motion_states_calc = 8
    rml_keep_current_vel_if_fallback_strategy = 16
    ruckig_minvel = 4
    ruckig_minaccel = 8

    physics_bullet = 0
    physics_ode = 1
    physics_vortex = 2
    physics_newton = 3
    physics_mujoco = 4

    pathproperty_show_line = 1
    pathproperty_show_orientation = 2
    pathproperty_closed_path = 4
    pathproperty_automatic_orientation = 8
    pathproperty_flat_path = 64
    pathproperty_show_position = 128

    texturemap_plane = 0
    texturemap_cylinder = 1
    texturemap_sphere = 2
    texturemap_cube = 3
    buffer_uint8 = 0
    buffer_int8 = 1
    buffer_uint16 = 2
    buffer_int16 = 3
    buffer_uint32 = 4
    buffer_int32 = 5
    buffer_float = 6
    buffer_double = 7
    buffer_uint8rgb = 8
    buffer_uint8bgr = 9
    buffer_uint8rgba = 10
    buffer_uint8argb = 11
    buffer_base64 = 12
    buffer_split = 13
    buffer_clamp = 256
