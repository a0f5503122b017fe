// SPDX-License-Identifier: BSD-3-Clause
// The flat faces and the round shapes that cast shadows in parallel light, in the cells of a grid across the light.
// Near a camera, shadows are found with them instead of rays. Meshes of many triangles are traced, in the cells that
// they may shade.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rays/face_lanes.hpp"
#include "rays/ray_packet.hpp"
#include "rays/ray_shape.hpp"
#include "scene/transform.hpp"

namespace bubblesim::rays {

class FacesInLight {
 public:
  /// Forgets all shapes. `to_light`: unit vector. `middle`: of the grid, near what is visible. `pixels`: of the image.
  void start(const Vector3& to_light, const Vector3& middle, std::size_t pixels);

  /// Adds a shape in a frame (null: the world).
  void add(const RayShape& shape, const Transform* frame);
  /// Call it when all is added.
  void arrange();

  /// Sets tfar of the used rays that are blocked to -infinity, as RayScene::occlude(), and returns true; returns false
  /// if they must be traced. The rays begin at surfaces and lead to the light.
  bool shade(RTCRay16& rays, const RayMask& mask) const;

 private:
  struct Cell {
    static constexpr std::size_t kMostFaces = 12;
    static constexpr std::size_t kMostRounds = 4;

    bool needs_rays = false;
    std::uint8_t count = 0;
    double top = 0;  // of what needs rays
    std::uint8_t round_count = 0;
    std::array<std::uint16_t, kMostFaces> faces;
    std::array<std::uint32_t, kMostRounds> rounds;
  };

  struct CellRange {
    std::array<std::size_t, 2> first;
    std::array<std::size_t, 2> end;
  };

  void add_face(const Vector3* corners, std::size_t count);
  static void need_rays(const LightBlock& bounds, Cell& cell);
  CellRange cells_of(const LightBlock& block) const;
  template <class Change>
  void change_cells(const LightBlock& bounds, const Change& change);

  Matrix3 turn_ = Matrix3::Identity();  // into the axes of the light, the last of which leads to it
  Vector3 middle_;
  LightFrame frame_{};     // the same
  double half_ = 0;        // m, of a side of the grid
  bool is_whole_ = false;  // nothing shades beyond the grid
  std::vector<LightFace> faces_;
  std::vector<LightBlock> bounds_;  // of the faces
  std::vector<PlacedRound> rounds_;
  std::vector<LightBlock> round_bounds_;
  std::vector<LightBlock> others_;
  std::vector<Cell> cells_;
  std::size_t most_triangles_ = 0;
  std::size_t triangles_ = 0;
};

}  // namespace bubblesim::rays
