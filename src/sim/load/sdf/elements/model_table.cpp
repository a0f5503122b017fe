// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/elements/element_table.hpp"

namespace bubblesim {

const char* const kModelTable = R"TABLE(
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
  air_speed any ~ the sensor is not simulated
  dvl any ~ the sensor is not simulated
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
  auto_inertia_params any ~ auto inertias are exact
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
    density number 1000
    auto_inertia_params any ~ auto inertias are exact
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
  bubblesim:position_gain number

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

=script
  loop flag true
  delay_start number 0 0..1e9
  auto_start flag true
  trajectory none
    @id integer 0
    @type text
    @tension number 0
    waypoint none
      time number 0 0..1e9 required
      pose pose
        &pose

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
  gripper none
    @name text
    grasp_check none
      detach_steps integer 40 0..1e9
      attach_steps integer 20 0..1e9
      min_contact_count integer 2 1..1e9
    gripper_link text required
    palm_link text required
  model none
    &model
  include none
    &include
  bubblesim:alias text
  bubblesim:axis_convention text
  bubblesim:child_script text
  bubblesim:script none
    &script
  bubblesim:is_object flag true
  bubblesim:object none
    &object
)TABLE";

}  // namespace bubblesim
