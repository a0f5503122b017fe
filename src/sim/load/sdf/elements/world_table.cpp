// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/elements/element_table.hpp"

namespace bubblesim {

const char* const kWorldTable = R"TABLE(
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

=actor
  @name text
  pose pose
    &pose
  static flag true ~ actors are moved by their script
  skin any ~ a person is a capsule
  animation any ~ a person is a capsule
    @name text
  script none
    &script
  frame none
    &frame
  link any
    @name text
  joint any
    @name text
  plugin any
    &plugin

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
      bubblesim:solver text
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
    actor none
      &actor
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
    bubblesim:collection none
      @name text
      item none
        what text object
        id integer -1
        removes flag false
  model none
    &model
  light none
    &light
  actor none
    &actor
)TABLE";

}  // namespace bubblesim
