// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/elements/element_table.hpp"

namespace bubblesim {

const char* const kElementTable = R"TABLE(
=noise
  @type text none
  type text none
  mean number 0
  stddev number 0 0..
  &noise_bias

=noise_of_rays
  @type text gaussian
  type text gaussian
  mean number 0
  stddev number 0
  &noise_bias

=noise_bias
  bias_mean number 0
  bias_stddev number 0 0..
  dynamic_bias_stddev number 0 ~ biases are constant
  dynamic_bias_correlation_time number 0 ~ biases are constant
  precision number 0

=axes_with_noise
  x none
    noise none
      &noise
  y none
    noise none
      &noise
  z none
    noise none
      &noise

=pose
  @relative_to text
  @frame text
  @rotation_format text euler_rpy
  @degrees flag false

=plugin
  @name text
  @filename text

=geometry
  empty any
  box none
    size vector3 '1 1 1' required
  sphere none
    radius number 1 required
  cylinder none
    radius number 1 required
    length number 1 required
  capsule none
    radius number 0.5 required
    length number 1 required
  cone none
    radius number 0.5 required
    length number 1 required
  ellipsoid none
    radii vector3 '1 1 1' required
  plane none
    normal vector3 '0 0 1' required
    size vector2 '1 1' required
  mesh none
    @optimization text
    uri text required
    submesh none
      name text required
      center flag false
    scale vector3 '1 1 1'
    convex_decomposition any ~ bubblesim:convex chooses the parts
  polyline none
    point vector2 '0 0' required
    height number 1 required
  heightmap none
    uri text required
    size vector3 '1 1 1'
    pos vector3 '0 0 0'
    texture any ~ the ground has one colour
    blend any ~ the ground has one colour
    use_terrain_paging flag false ~ the ground is one mesh
    sampling integer 1 ~ each pixel is a vertex
  image none
    uri text required
    scale number 1 required
    threshold integer 200 required
    height number 1 required
    granularity integer 1 ~ each pixel is a box

=material
  script none
    uri text
    name text
  shader any ~ the renderer has one shader
  render_order number 0 ~ rays need no order
  lighting flag true ~ all surfaces are lit
  ambient color '0 0 0 1' ~ the diffuse colour is used
  diffuse color '0 0 0 1'
  specular color '0 0 0 1' ~ surfaces are matt
  shininess number 0 ~ surfaces are matt
  emissive color '0 0 0 1'
  double_sided flag false ~ all surfaces have two sides
  pbr none
    metal none
      &pbr
    specular none
      &pbr
  bubblesim:checker_size number
  bubblesim:checker_color vector3

=pbr
  albedo_map text
  roughness_map any ~ surfaces are matt
  roughness any ~ surfaces are matt
  metalness_map any ~ surfaces are matt
  metalness any ~ surfaces are matt
  specular_map any ~ surfaces are matt
  glossiness_map any ~ surfaces are matt
  glossiness any ~ surfaces are matt
  environment_map any ~ surfaces are matt
  ambient_occlusion_map any ~ light has one bounce
  normal_map any ~ normals are those of the mesh
  emissive_map any ~ the emissive colour is used
  light_map any ~ light has one bounce

=surface
  bounce none
    restitution_coefficient number 0 0..1
    threshold number 100000
  friction none
    torsional none
      coefficient number 1 0..
      use_patch_radius flag true
      patch_radius number 0 0..
      surface_radius number 0 0..
      ode any ~ torsional slip is not simulated
    ode none
      mu number 1 0..
      mu2 number 1 0..
      fdir1 vector3 '0 0 0'
      slip1 number 0
      slip2 number 0
    bullet any ~ for another physics engine
    bubblesim:rolling number
  contact none
    collide_without_contact flag false
    collide_without_contact_bitmask integer 1 ~ collide_without_contact holds for all shapes
    collide_bitmask integer 65535
    category_bitmask integer 65535 ~ collide_bitmask is used
    poissons_ratio number 0.3 ~ contacts are not elastic bodies
    elastic_modulus number -1 ~ contacts are not elastic bodies
    ode none
      soft_cfm number 0
      soft_erp number 0.2
      kp number 1e12
      kd number 1
      max_vel number 0.01
      min_depth number 0
    bullet any ~ for another physics engine
  soft_contact any ~ for another physics engine

=light
  @name text
  @type text point
  pose pose
    &pose
  cast_shadows flag false
  intensity number 1
  diffuse color '1 1 1 1'
  specular color '0.1 0.1 0.1 1' ~ surfaces are matt
  attenuation none
    range number 10
    linear number 1
    constant number 1
    quadratic number 0
  direction vector3 '0 0 -1'
  spot none
    inner_angle number 0
    outer_angle number 0
    falloff number 0
  light_on flag true
  visualize flag true ~ lights are not drawn

=place
  id integer required
  parent integer -1
  order integer 0
  model flag false
  script text
  old_name text
  parameter text
    @name text
    @unit text
  data text
    @name text

=object
  @name text
  kind text dummy
  link text
  joint none
    @type text revolute
    position number 0
    lower number -1e16
    upper number 1e16
    screw_thread_pitch number 0
    mimic none
      @joint text
      multiplier number 1
      offset number 0
  pose pose
    &pose
  bubblesim:alias text
  bubblesim:place none
    &place

=sensor
  @name text
  @type text
  pose pose
    &pose
  always_on flag false ~ sensors measure always
  update_rate number 0
  visualize flag false ~ the window shows each sensor
  topic text
  enable_metrics flag false ~ rates are published on /diagnostics
  gz_frame_id text
  ignition_frame_id text
  frame_id text
  plugin any
    &plugin
  &sensor_kinds
  air_pressure any ~ the sensor is not simulated
  air_speed any ~ the sensor is not simulated
  dvl any ~ the sensor is not simulated
  logical_camera any ~ the sensor is not simulated
  rfid any ~ the sensor is not simulated
  rfidtag any ~ the sensor is not simulated
  transceiver any ~ the sensor is not simulated
  bubblesim:alias text
  bubblesim:place none
    &place
  bubblesim:topic text
  bubblesim:frame text

=inertial
  @auto flag false
  mass number 1 required
  density number 1000
  auto_inertia_params any ~ inertias are computed from shapes
  pose pose
    &pose
  inertia none
    ixx number 1 required
    ixy number 0 required
    ixz number 0 required
    iyy number 1 required
    iyz number 0 required
    izz number 1 required
  fluid_added_mass any ! the added mass of a fluid is not simulated

=link
  @name text
  pose pose
    &pose
  gravity flag true
  enable_wind flag false
  self_collide flag false ~ self_collide of the model is used
  kinematic flag false ! kinematic links are not supported, forces and gravity move the link
  must_be_base_link flag false ~ any link may be a base
  velocity_decay none
    linear number 0
    angular number 0
  inertial none
    &inertial
  collision none
    @name text
    pose pose
      &pose
    laser_retro number 0 ~ laser_retro of the visual is used
    max_contacts integer 10
    density number 1000 ~ of auto inertias
    auto_inertia_params any ~ of auto inertias
    geometry none
      &geometry
    surface none
      &surface
    bubblesim:convex text
  visual none
    @name text
    pose pose
      &pose
    cast_shadows flag true
    laser_retro number 0
    transparency number 0
    visibility_flags integer 4294967295 ~ all is visible
    meta any ~ for other viewers
    material none
      &material
    geometry none
      &geometry
    plugin any ~ for other viewers
  sensor none
    &sensor
  light none
    &light
  projector any ! projectors are not simulated
  audio_sink any ! sound is not simulated
  audio_source any ! sound is not simulated
  battery any ! batteries are not simulated
  particle_emitter any ! particles are not simulated
  bubblesim:alias text
  bubblesim:carrier text
  bubblesim:place none
    &place

=axis
  xyz vector3 '0 0 1' required
    @expressed_in text
  use_parent_model_frame flag false
  initial_position number 0 ~ removed in SDFormat 1.9
  mimic none
    @joint text
    @axis text axis
    multiplier number 1
    offset number 0
    reference number 0
  bubblesim:mimic none
    @joint text
    @axis text axis
    multiplier number 1
    offset number 0
    reference number 0
  dynamics none
    damping number 0
    friction number 0
    spring_reference number 0
    spring_stiffness number 0
  limit none
    lower number -1e16 required
    upper number 1e16 required
    effort number -1
    velocity number -1
    stiffness number 1e8 ~ stops are rigid
    dissipation number 1 ~ stops are rigid
  bubblesim:motor text
  bubblesim:target number

=joint
  @name text
  @type text
  pose pose
    &pose
  parent text required
  child text required
  gearbox_ratio number 1
  gearbox_reference_body text
  thread_pitch number 1
  screw_thread_pitch number 1
  axis none
    &axis
  axis2 none
    &axis
  physics any ~ for other physics engines
  sensor none
    &sensor
  bubblesim:alias text
  bubblesim:place none
    &place

=frame
  @name text
  @attached_to text
  pose pose
    &pose

=include
  @merge flag false
  @name text
  @placement_frame text
  uri text required
  name text
  pose pose
    &pose
  static flag false
  placement_frame text
  plugin any
    &plugin
  experimental:params any ! parameters of an included model are not supported
  bubblesim:alias text
  bubblesim:axis_convention text
  bubblesim:child_script text

=model
  @name text
  @canonical_link text
  @placement_frame text
  pose pose
    &pose
  static flag false
  self_collide flag false
  allow_auto_disable flag true ~ models at rest sleep
  enable_wind flag false
  frame none
    &frame
  link none
    &link
  joint none
    &joint
  plugin any
    &plugin
  gripper any ! grippers hold objects by contacts, not by a joint
    @name text
  model none
    &model
  include none
    &include
  bubblesim:alias text
  bubblesim:axis_convention text
  bubblesim:child_script text
  bubblesim:is_object flag true
  bubblesim:object none
    &object

=state_part
  @name text
  pose pose
    &pose
  scale vector3 '1 1 1'
  frame any
  joint any
  link none
    @name text
    pose pose
      &pose
    velocity pose
    acceleration pose
    wrench pose
    collision any
  model none
    &state_part

=sdf
  @version text
  world none
    @name text
    gravity vector3 '0 0 -9.8' required
    magnetic_field vector3 '5.5645e-6 22.8758e-6 -42.3884e-6' required
    wind none
      linear_velocity vector3 '0 0 0'
    physics none
      @name text
      @default flag false
      @type text ode
      max_step_size number 0.001 required
      real_time_factor number 1 ~ --speed chooses the pace
      real_time_update_rate number 1000 ~ --speed chooses the pace
      max_contacts integer 20 ~ max_contacts of the shapes is used
      dart any ~ for another physics engine
      simbody any ~ for another physics engine
      bullet any ~ for another physics engine
      ode any ~ the solver chooses its parameters
      profile any ~ Gazebo's
      bubblesim:substeps text
    scene none
      ambient color '0.4 0.4 0.4 1' required
      background color '0.7 0.7 0.7 1' required
      sky any
      shadows flag true required
      fog any ~ the air is clear
      grid flag true ~ the window has its own grid
      origin_visual flag true ~ the window has its own axes
    light none
      &light
    frame none
      &frame
    model none
      &model
    include none
      &include
    plugin any
      &plugin
    spherical_coordinates none
      surface_model text EARTH_WGS84
      surface_axis_equatorial any ~ the ellipsoid is WGS84
      surface_axis_polar any ~ the ellipsoid is WGS84
      world_frame_orientation text ENU
      latitude_deg number 0 required
      longitude_deg number 0 required
      elevation number 0 required
      heading_deg number 0 required
    state none
      @world_name text
      sim_time any
      wall_time any
      real_time any
      iterations any
      insertions any
      deletions any
      model none
        &state_part
      light none
        &state_part
    atmosphere any ~ drag and wings have their own density
    gui any ~ the window has its own views
    audio any ~ sound is not simulated
    actor any ! actors are not simulated
      @name text
    road any ! roads are not simulated
      @name text
    population any ! populations of models are not simulated
      @name text
    joint any ! joints between models are not simulated
      @name text
    particle_emitter any ! particles are not simulated
      @name text
    bubblesim:time_step number
    bubblesim:axis_convention text
    bubblesim:on_divergence text
    bubblesim:randomize any
    bubblesim:object none
      &object
  model none
    &model
  light none
    &light
  actor any ! actors are not simulated
    @name text
)TABLE";

}  // namespace bubblesim
