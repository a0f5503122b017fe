// SPDX-License-Identifier: BSD-3-Clause
// Flat faces in the image of a pinhole or across parallel light, sixteen places at a time, in double precision. A pixel
// is a direction (1, left, up) from the eye, in the camera's frame.
//
// Each side of a face, with the eye, spans a plane; a direction is within the face if it is on the inner side of all of
// them, where a product with three numbers is not negative. Another product gives the nearness, 1 / depth, because that
// is linear in the image: Olano and Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates", 1997.
#pragma once

#include <cstddef>
#include <cstdint>

#include "rays/ray_packet.hpp"

namespace bubblesim::rays {

/// A number for each place in a plane: constant + x * left + y * up in an image.
struct Linear {
  double constant = 0;
  double x = 0;
  double y = 0;
};

constexpr std::size_t kSides = 4;

/// A face whose front is towards the eye. Fewer than four sides: the others are zero, and leave nothing out.
struct ImageFace {
  Linear sides[kSides];  ///< not negative within the face
  Linear nearness;       ///< 1 / depth, 1/m; not positive behind the eye
};

/// The nearest faces in sixteen pixels of a row.
struct alignas(64) NearestFaces {
  double nearness[kPacket];  ///< 1/m; the least one where there is none
  double face[kPacket];      ///< index in the list, or -1
};

/// Nearness from `least` (exclusive) to `most`, 1/m.
struct NearnessLimits {
  double least;
  double most;
};

/// Finds the nearest face in each pixel of a row. `faces`: those to look at, as indices of `all`. Of two faces at the
/// same depth the first of them is found.
void find_nearest_faces(const ImageFace* all, const std::uint16_t* faces, std::size_t count,
                        const NearnessLimits& limits, double up, const double* left, NearestFaces& seen);

/// Depths of the nearest faces, m; `none` where there is none.
void keep_depths(const NearestFaces& seen, float none, float* depths);

/// A face across parallel light. Fewer than four sides: the others are zero.
struct LightFace {
  Linear sides[kSides];  ///< of the place across the light; not negative within the face
  Linear height;         ///< m, towards the light
};

/// Places in the axes of a light: two across it and the height towards it; m.
struct alignas(64) LightPlaces {
  double along[3][kPacket];
};

/// Axes as rows.
struct LightFrame {
  double axes[3][3];
  double middle[3];  ///< world
};
void place_in_light(const LightFrame& frame, const RTCRay16& rays, LightPlaces& places);

/// A block in the axes of a light, m.
struct LightBlock {
  double low[3];
  double high[3];
};
/// A block around the used places, a millimetre larger than needed.
LightBlock block_around(const LightPlaces& places, const RayMask& mask);

/// Sets tfar of the used rays that begin below one of the faces to -infinity.
void shade_below(const LightFace* all, const std::uint16_t* faces, std::size_t count, const LightPlaces& places,
                 const RayMask& mask, RTCRay16& rays);

}  // namespace bubblesim::rays
