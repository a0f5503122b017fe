# SPDX-License-Identifier: BSD-3-Clause
"""Constants of the newest versions of CoppeliaSim, under names of their own, and of the oldest ones of V-REP."""

from __future__ import annotations


class VersionConstants:
    """A part of the `sim` module."""

    # Since version 4.8
    sceneobject_shape = 0
    sceneobject_joint = 1
    sceneobject_graph = 2
    sceneobject_camera = 3
    sceneobject_dummy = 4
    sceneobject_proximitysensor = 5
    sceneobject_visionsensor = 9
    sceneobject_forcesensor = 12
    sceneobject_light = 13
    sceneobject_octree = 15
    sceneobject_pointcloud = 16
    sceneobject_script = 17
    sceneobject_marker = 18
    objecttype_sceneobject = 109
    objecttype_collection = 115
    objecttype_script = objecttype_detachedscript = 117
    objecttype_texture = 120
    objecttype_mesh = 122
    objecttype_interfacestack = 123
    objecttype_drawingobject = 124
    objecttype_customobject = 125
    light_omnidirectional = 1
    light_spot = 2
    light_directional = 3
    shape_simple = 20
    shape_compound = 21
    proximitysensor_pyramid = 30
    proximitysensor_cylinder = 31
    proximitysensor_disc = 32
    proximitysensor_cone = 33
    proximitysensor_ray = 34
    lang_undefined = -1
    lang_lua = 0
    lang_python = 1
    scripttype_passive = 9
    scriptstate_unloaded = 0
    scriptstate_uninitialized = 1
    scriptstate_initialized = 2
    scriptstate_ended = 3
    scriptstate_error = 8
    scriptstate_suspended = 16
    scriptexecorder_first = 0
    scriptexecorder_normal = 1
    scriptexecorder_last = 2
    simulation_running = 0x11
    simulation_lastbeforestop = 0x16
    jointdynctrl_spring = jointdynctrl_springcb = 12
    dummytype_dynloopclosure = 0
    dummytype_dyntendon = 7
    dummytype_neutral = dummytype_default = 8
    dummytype_assembly = 9
    materialcomponent_diffuse = 0
    materialcomponent_lightdiffuse = 1
    materialcomponent_specular = 2
    materialcomponent_emission = 3
    markertype_points = 0
    markertype_lines = 1
    markertype_triangles = 2
    markertype_spheres = 7
    markertype_squares = 9
    markertype_discs = 10
    markertype_cubes = 11
    markertype_cylinders = 12
    markertype_custom = 13
    markeropts_local = 1
    markeropts_cyclic = 2
    markeropts_overlay = 4
    textureapplymode_modulate = 0
    textureapplymode_decal = 1
    textureapplymode_add = 2
    string_text = 0
    string_binary = 1
    string_buffer = 2
    platform_windows = 0
    platform_macos = 1
    platform_linux = 2
    handle_mainscript = -5
    handle_inverse = -14
    handle_appstorage = -15
    handle_sandbox = -17
    handleflag_setmultiple = 0x0100000000000000
    verbosity_useglobal = -1
    verbosity_questions = 410
    verbosity_tracelua = 800
    verbosity_traceall = 900
    propertytype_bool = 0
    propertytype_int = 1
    propertytype_float = 2
    propertytype_string = 3
    propertytype_buffer = 4
    propertytype_vector3 = 5
    propertytype_quaternion = 6
    propertytype_pose = 7
    propertytype_color = 10
    propertytype_floatarray = 11
    propertytype_table = 12
    propertytype_intarray = 13
    propertytype_intarray2 = 15
    propertytype_long = 16
    propertytype_null = 17
    propertytype_matrix = 18
    propertytype_array = 19
    propertytype_map = 20
    propertytype_handle = 21
    propertytype_handlearray = 22
    propertytype_stringarray = 23
    propertytype_group = 24
    propertytype_enum = 25
    propertyinfo_notwritable = 0x1
    propertyinfo_notreadable = 0x2
    propertyinfo_removable = 0x4
    propertyinfo_largedata = 0x100

    # Script parameters
    scriptintparam_execorder = 1
    scriptintparam_execcount = 2
    scriptintparam_enabled = 4
    scriptintparam_type = 7
    scriptintparam_handle = 8
    scriptintparam_objecthandle = 9
    scriptintparam_lang = 10
    scriptattribute_debuglevel = 6
    scriptattribute_scripttype = 7
    scriptattribute_scripthandle = 8
    scriptstringparam_description = 10000
    scriptstringparam_name = 10001
    scriptstringparam_text = 10002
    scriptstringparam_nameext = 10003

    # The value of sim_call_type, equal in all versions here: scripts compare it with these names.
    syscb_init = customizationscriptcall_initialization = mainscriptcall_initialization = 0
    syscb_actuation = customizationscriptcall_simulationactuation = mainscriptcall_regular = 1
    syscb_sensing = customizationscriptcall_simulationsensing = 2
    syscb_cleanup = customizationscriptcall_cleanup = mainscriptcall_cleanup = 3
    syscb_beforesimulation = customizationscriptcall_lastbeforesimulation = 4
    syscb_aftersimulation = customizationscriptcall_firstaftersimulation = 5
    syscb_suspend = customizationscriptcall_simulationpausefirst = 6
    syscb_suspended = customizationscriptcall_simulationpause = 7
    syscb_resume = customizationscriptcall_simulationpauselast = 8
    syscb_nonsimulation = customizationscriptcall_nonsimulation = 9
    syscb_beforeinstanceswitch = customizationscriptcall_lastbeforeinstanceswitch = 10
    syscb_afterinstanceswitch = customizationscriptcall_firstafterinstanceswitch = 11
    syscb_beforecopy = customizationscriptcall_beforecopy = 12
    syscb_aftercopy = customizationscriptcall_aftercopy = 13
    syscb_jointcallback = 17
    syscb_contactcallback = 18
    syscb_threadmain = 26
    syscb_dyncallback = 27
    syscb_vision = 29
    syscb_trigger = 30
    syscb_userconfig = 31

    message_prox_sensor_select_down = 9
    message_prox_sensor_select_up = 10
    message_pick_select_down = 11
    mill_pyramid_subtype = 40
    mill_cylinder_subtype = 41
    mill_disc_subtype = 42
    mill_cone_subtype = 43
    object_marker_type = 18
    ik_avoidance_constraint = 64
    lua_arg_nil = script_arg_null = 0
    lua_arg_bool = script_arg_bool = 1
    lua_arg_int = script_arg_int32 = 2
    lua_arg_float = script_arg_float = 3
    lua_arg_string = script_arg_string = 4
    lua_arg_invalid = script_arg_invalid = 5
    lua_arg_charbuff = script_arg_charbuff = 6
    lua_arg_double = script_arg_double = 7
    lua_arg_table = script_arg_table = 8
    ui_menu_title = 1
    ui_menu_minimize = 2
    ui_menu_close = 4
    ui_menu_systemblock = 8
    ui_property_relativetoleftborder = 0x8
    ui_property_relativetotopborder = 0x10
    ui_property_fixedwidthfont = 0x20
    ui_property_systemblock = 0x40
    ui_property_settocenter = 0x80
    ui_property_rolledup = 0x100
    ui_property_selectassociatedobject = 0x200
    ui_property_visiblewhenobjectselected = 0x400
    ui_property_systemblockcanmovetofront = 0x800
    ui_property_pauseactive = 0x1000
    banner_left = 0x1
    banner_right = 0x2
    banner_nobackground = 0x4
    banner_overlay = 0x8
    banner_followparentvisibility = 0x10
    banner_clickselectsparent = 0x20
    banner_clicktriggersevent = 0x40
    banner_facingcamera = 0x80
    banner_fullyfacingcamera = 0x100
    banner_backfaceculling = 0x200
    banner_keepsamesize = 0x400
    banner_bitmapfont = 0x800
    callbackid_rossubscriber = 1
    callbackid_dynstep = 2
    callbackid_userdefined = 1000
    api_error_report = api_errormessage_report = 1
    api_error_output = api_errormessage_output = 2
    api_warning_output = 4
    api_errormessage_ignore = 0
    distcalcmethod_dl = 0
    distcalcmethod_dac = 1
    distcalcmethod_max_dl_dac = 2
    distcalcmethod_dl_and_dac = 3
    distcalcmethod_sqrt_dl2_and_dac2 = 4
    distcalcmethod_dl_if_nonzero = 5
    distcalcmethod_dac_if_nonzero = 6
    pathproperty_keep_x_up = 0x800
    displayattribute_renderpass = 0x1
    displayattribute_depthpass = 0x2
    displayattribute_pickpass = 0x4
    displayattribute_selected = 0x8
    displayattribute_forcewireframe = 0x40
    displayattribute_forbidedges = 0x100
    displayattribute_forvisionsensor = 0x800
    objectspecialproperty_cuttable = 0x400
    modelproperty_not_cuttable = 0x10
