// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/elements/element_table.hpp"

namespace bubblesim {

const char* const kShapeTable = R"TABLE(
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
    bubblesim:own_bitmask integer
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
)TABLE";

}  // namespace bubblesim
