// SPDX-License-Identifier: BSD-3-Clause
// Arithmetic on the surfaces that the sixteen rays of a packet hit. Places are in double precision, so that shadows and
// checkerboards are exact far from the origin; colours are in single precision.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "bubblesim/scene.hpp"
#include "bubblesim/triangle_mesh.hpp"
#include "rays/ray_packet.hpp"

namespace bubblesim::lanes {

constexpr std::size_t kLanes = rays::kPacket;

struct alignas(64) Places {
  double x[kLanes], y[kLanes], z[kLanes];
};
struct alignas(64) Normals {
  float x[kLanes], y[kLanes], z[kLanes];
};
struct alignas(64) Colors {
  float r[kLanes], g[kLanes], b[kLanes];
};
/// Places on an image, from its lower left corner (0, 0) to (1, 1).
struct alignas(64) ImagePlaces {
  float right[kLanes], up[kLanes];
};
/// The normals of the three corners of each ray's triangle, and the ray's place in it.
struct alignas(64) CornerNormals {
  Normals corner[3];
  float second[kLanes], third[kLanes];
};
using Turn = std::array<double, 9>;  // a rotation matrix, row by row
using Mask = rays::RayMask;

/// Where the rays end, and the unit normals there, in the frame in which Embree has them.
void find_places(const RTCRayHit16& packet, Places& places, Normals& normals);

void turn_normals(const Turn& turn, const Mask& mask, Normals& normals);
void set_normals(const Vector3& normal, const Mask& mask, Normals& normals);
/// Replaces normals by those interpolated between the corners, turned by `turn`, that are on the same side.
void smooth_normals(const CornerNormals& corners, const Turn& turn, const Mask& mask, Normals& normals);

/// The places in a frame at `position` with the axes `turn`.
void into_frame(const Turn& turn, const Vector3& position, Places& places);

void paint(const Color& color, const Mask& mask, Colors& colors);
/// A checkerboard of the material's two colours. `distances` are the lengths of the rays.
void paint_checker(const Material& material, const Places& in_shape, const float* distances, const Mask& mask,
                   Colors& colors);
/// An image that repeats; colours are interpolated between pixel centres.
void paint_texture(const Texture& texture, const ImagePlaces& places, const Mask& mask, Colors& colors);
/// Each face of a box shows the whole image: upright on the sides, the upper edge at +x on top and bottom.
void place_on_box(const Vector3& size, const Places& in_shape, ImagePlaces& places);

/// Converts values from 0 to 1 to bytes, of `count` pixels.
void to_bytes(const Colors& colors, std::size_t count, std::uint8_t* rgb);

}  // namespace bubblesim::lanes
