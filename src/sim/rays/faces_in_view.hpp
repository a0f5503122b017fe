// SPDX-License-Identifier: BSD-3-Clause
// The flat faces and the round shapes in the view of a pinhole camera, for tiles of its image: a tile with few of them
// is rasterized instead of traced. Meshes of many triangles are traced, in the tiles that they may appear in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rays/face_lanes.hpp"
#include "rays/packet_math.hpp"
#include "rays/ray_packet.hpp"
#include "rays/ray_shape.hpp"
#include "scene/transform.hpp"

namespace bubblesim::rays {

struct Pinhole {
  Vector3 eye;   ///< world
  Matrix3 turn;  ///< of the camera's axes: x ahead, y to the left, z up
  double near;   ///< m along x
  double far;    ///< m along x
  double left;   ///< of the left border, at 1 m; the right one is opposite
  double up;     ///< of the upper border, at 1 m
  std::size_t pixels;
};

/// Part of an image plane, at 1 m.
struct ImageArea {
  double right;
  double left;
  double down;
  double up;
};

/// A few columns and rows of an image.
struct Tile {
  /// With more faces, rays are faster.
  static constexpr std::size_t kMostFaces = 24;
  static constexpr std::size_t kMostRounds = 6;

  bool needs_rays = false;
  bool is_filled = false;  ///< by its only face
  std::size_t count = 0;
  double filled_to = 0;  ///< 1/m, nearness; what is farther is hidden in the whole tile
  std::array<std::uint16_t, kMostFaces> faces;
  std::size_t round_count = 0;
  std::array<std::uint32_t, kMostRounds> rounds;
};

class FacesInView {
 public:
  /// Forgets all shapes.
  void start(const Pinhole& view);
  /// Adds a shape in a frame (null: the world) with the ids of its hits.
  void add(const RayShape& shape, const Transform* frame, unsigned geometry, unsigned instance);
  void add(const PlaneEquation& plane, unsigned geometry, unsigned instance);
  /// Call it when all is added.
  void sort();

  /// The tiles of the rows from `down` to `up`; `borders` are those of the columns, from left to right: one more than
  /// tiles.
  void divide(double down, double up, const std::vector<double>& borders, std::vector<Tile>& tiles) const;

  /// Sets the hits of a packet, as RayScene::trace(), for a tile that needs no rays. `left` and `up`: the
  /// directions of its rays.
  void rasterize(const Tile& tile, double up, const double* left, RayPacket& packet) const;

 private:
  struct Face {
    ImageArea bounds;
    double nearest;  // 1/m, of all of its points
    float normal[3];
    unsigned geometry;
    unsigned instance;
    unsigned primitive;
    bool is_triangle;
  };
  /// What needs rays.
  struct Other {
    ImageArea bounds;
    double nearest;
  };
  struct Round {
    Other extent;
    PlacedRound shape;
  };
  struct Placed;

  void add_face(const Vector3* corners, std::size_t count, const Placed& placed, unsigned primitive);
  void add_to_tile(std::uint16_t index, const ImageArea& area, Tile& tile) const;
  template <class Look>
  static void for_each_tile(const ImageArea& area, const ImageArea& rows, const std::vector<double>& borders,
                            std::vector<Tile>& tiles, const Look& look);
  void rasterize_faces(const Tile& tile, double up, const double* left, RayPacket& packet) const;
  void place_in_triangles(const Tile& tile, const NearestFaces& seen, double up, const double* left,
                          RTCHit16& hit) const;

  Pinhole view_{};
  std::vector<ImageFace> lines_;
  std::vector<Face> faces_;
  std::vector<std::uint16_t> order_;  // of the faces, the nearest first
  std::vector<Other> others_;
  std::vector<Round> rounds_;
  std::size_t triangles_ = 0;  // of the meshes in view
};

}  // namespace bubblesim::rays
