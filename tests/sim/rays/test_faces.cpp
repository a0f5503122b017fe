// SPDX-License-Identifier: BSD-3-Clause
// Rasterized images and shadows compared with traced ones.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "rays/faces_in_light.hpp"
#include "rays/faces_in_view.hpp"
#include "rays/ray_scene.hpp"
#include "scenes.hpp"
#include "surfaces.hpp"
#include "traced.hpp"

namespace bubblesim::test::test_faces {
namespace {

using rays::kPacket;

constexpr int kColumns = 160;
constexpr int kRows = 120;
constexpr std::size_t kPixels = 640 * 480;  // for as many triangles as there may be
constexpr double kFocal = 100;              // pixels
constexpr std::size_t kRowsOfTile = 8;
constexpr double kBesideEdge = 1e-3;  // of a pixel: rays this far apart see the same, or an edge is between them

rays::Pinhole pinhole(const Pose& pose, double near = 0.05, double far = 100) {
  return {pose.position, pose.orientation.toRotationMatrix(), near, far, kColumns / 2.0 / kFocal, kRows / 2.0 / kFocal,
          kPixels};
}

/// Both ways to see sixteen pixels of a row.
class Eye {
 public:
  Eye(const Traced& traced, const rays::Pinhole& view) : traced_(traced), view_(view) {
    faces_.start(view);
    traced.rays.collect(faces_);
    for (std::size_t column = 0; column <= kColumns; column += kPacket) borders_.push_back(left_of(column));
  }

  static double left_of(double column) { return (kColumns / 2.0 - column) / kFocal; }
  static double up_of(double row) { return (kRows / 2.0 - row) / kFocal; }

  std::vector<rays::Tile> tiles(std::size_t first_row) const {
    std::vector<rays::Tile> tiles;
    faces_.divide(up_of(static_cast<double>(first_row + kRowsOfTile)), up_of(static_cast<double>(first_row)), borders_,
                  tiles);
    return tiles;
  }

  rays::RayPacket by_rays(double row, double first_column) const {
    rays::RayPacket packet = aimed(row, first_column);
    traced_.rays.trace(packet, true);
    return packet;
  }

  rays::RayPacket by_faces(const rays::Tile& tile, double row, double first_column) const {
    rays::RayPacket packet = aimed(row, first_column);
    faces_.rasterize(tile, up_of(row), left_.data(), packet);
    return packet;
  }

  ObjectId link(const rays::RayPacket& packet, std::size_t i) const {
    return packet.hit(i) ? traced_.rays.shape(packet, i).link : kNoObject;
  }

  /// Whether rays close to a pixel see different things.
  bool is_at_edge(double row, double column) const {
    const auto seen = [&](double down, double right) {
      const rays::RayPacket packet = by_rays(row + down, column + right);
      return std::make_pair(link(packet, 0), packet.hit(0) ? packet.data.hit.primID[0] : 0U);
    };
    const auto first = seen(-kBesideEdge, -kBesideEdge);
    return seen(-kBesideEdge, kBesideEdge) != first || seen(kBesideEdge, -kBesideEdge) != first ||
           seen(kBesideEdge, kBesideEdge) != first;
  }

 private:
  rays::RayPacket aimed(double row, double first_column) const {
    rays::RayPacket packet;
    packet.start(view_.eye, static_cast<float>(view_.near), static_cast<float>(view_.far), kPacket);
    for (std::size_t i = 0; i < kPacket; ++i) left_[i] = left_of(first_column + static_cast<double>(i));
    const Matrix3& turn = view_.turn;
    rays::aim(packet.data.ray, turn.col(0) + up_of(row) * turn.col(2), turn.col(1), left_.data());
    return packet;
  }

  const Traced& traced_;
  rays::Pinhole view_;
  rays::FacesInView faces_;
  std::vector<double> borders_;
  mutable std::array<double, kPacket> left_{};
};

struct Compared {
  int hits = 0;
  int by_faces = 0;  // tiles
  int by_rays = 0;
};

/// Compares all pixels of an image. Depths differ by the rounding of single precision, more the flatter a ray meets.
Compared expect_as_by_rays(const Traced& traced, const rays::Pinhole& view) {
  const Eye eye(traced, view);
  Compared compared;
  for (std::size_t row = 0; row < kRows; ++row) {
    const std::vector<rays::Tile> tiles = eye.tiles(row / kRowsOfTile * kRowsOfTile);
    for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
      ++(tiles[tile].needs_rays ? compared.by_rays : compared.by_faces);
      if (tiles[tile].needs_rays) continue;
      const double down = static_cast<double>(row) + 0.5;
      const double right = static_cast<double>(tile * kPacket) + 0.5;
      const rays::RayPacket faces = eye.by_faces(tiles[tile], down, right);
      const rays::RayPacket rays = eye.by_rays(down, right);
      for (std::size_t i = 0; i < kPacket; ++i) {
        const double column = right + static_cast<double>(i);
        if (eye.link(faces, i) != eye.link(rays, i)) {
          EXPECT_TRUE(eye.is_at_edge(down, column)) << "row " << row << ", column " << column;
          continue;
        }
        if (!rays.hit(i)) continue;
        ++compared.hits;
        const Vector3 normal = traced.rays.normal(rays, i);
        const RTCRay16& ray = rays.data.ray;
        const Vector3 direction = Vector3(ray.dir_x[i], ray.dir_y[i], ray.dir_z[i]).normalized();
        const double inclined = std::abs(normal.dot(direction));
        if (inclined < 0.01 || eye.is_at_edge(down, column)) continue;
        EXPECT_NEAR(faces.data.ray.tfar[i], ray.tfar[i], 3e-6 * (1 + ray.tfar[i]) / inclined);
        EXPECT_LT((traced.rays.normal(faces, i) - normal).norm(), 1e-3);
      }
    }
  }
  return compared;
}

TEST(FacesInView, AreThoseThatRaysHitAmongAllShapes) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-12, 12);
  std::uniform_real_distribution<double> angle(-3, 3);
  const Traced traced(clutter(random));
  int hits = 0;
  int by_faces = 0;
  int by_rays = 0;
  for (int i = 0; i < 12; ++i) {
    const Pose pose(place(random), place(random), 8 + place(random) / 2, angle(random), angle(random), angle(random));
    const Compared compared = expect_as_by_rays(traced, pinhole(pose));
    hits += compared.hits;
    by_faces += compared.by_faces;
    by_rays += compared.by_rays;
  }
  EXPECT_GT(hits, 50000);
  EXPECT_GT(by_faces, 10 * by_rays);
}

TEST(FacesInView, AreThoseOfBoxesThatTouch) {
  // Between the boxes of a wall no ray may pass, and each pixel is of one of them.
  std::vector<ModelDescription> bricks;
  for (int column = 0; column < 12; ++column) {
    for (int row = 0; row < 11; ++row) {
      const std::string name = "Brick" + std::to_string(column) + "_" + std::to_string(row);
      bricks.push_back(still(model(name, link_with(Box{{1, 0.7, 0.6}}), at(5, 0.7 * (column - 6), 0.6 * (row - 5)))));
    }
  }
  const Traced traced(scene(bricks));
  const Eye eye(traced, pinhole(Pose(0, 0, 0, 0.1, 0.02, -0.03)));
  for (std::size_t row = 0; row < kRows; ++row) {
    const std::vector<rays::Tile> tiles = eye.tiles(row / kRowsOfTile * kRowsOfTile);
    for (std::size_t tile = 2; tile + 2 < tiles.size(); ++tile) {
      ASSERT_FALSE(tiles[tile].needs_rays);
      const rays::RayPacket faces =
          eye.by_faces(tiles[tile], static_cast<double>(row) + 0.5, static_cast<double>(tile * kPacket) + 0.5);
      for (std::size_t i = 0; i < kPacket; ++i) {
        ASSERT_TRUE(faces.hit(i)) << "row " << row;
        EXPECT_NEAR(faces.data.ray.tfar[i], 4.5, 0.5);
      }
    }
  }
}

TEST(FacesInView, BeginAtTheNearPlaneAndEndAtTheFarPlane) {
  const Traced traced(scene({still(model("Near", link_with(Box{{1, 9, 9}}), Pose(3, 0, 0, 0, 0.4, 0.3))),
                             still(model("Far", link_with(Box{{1, 99, 99}}), Pose(9, 0, 0, 0, 0.4, 0.3))), floor()}));
  for (const auto& [near, far] :
       {std::pair(0.05, 100.0), std::pair(2.7, 100.0), std::pair(0.05, 2.7), std::pair(2.5, 9.0)}) {
    EXPECT_GT(expect_as_by_rays(traced, pinhole(at(0, 0, 1), near, far)).by_faces, 0) << near << " to " << far;
  }
}

TEST(FacesInView, OfAShapeAroundTheEyeAreNotSeen) {
  for (const Geometry& housing :
       {Geometry(Box{{1, 1, 1}}), Geometry(Cylinder{0.5, 1}), Geometry(Sphere{1}), Geometry(box_mesh({1, 1, 1}))}) {
    for (const bool moves : {false, true}) {
      ModelDescription around = model("Housing", link_with(housing), Pose(0.1, 0, 1, 0.2, 0.1, 0.5));
      around.is_static = !moves;
      const Traced traced(scene({around, floor(), still(model("Wall", link_with(Box{{1, 3, 3}}), at(5, 0, 1)))}));
      EXPECT_EQ(expect_as_by_rays(traced, pinhole(at(0, 0, 1))).by_rays, 0);
    }
  }
}

/// A bumpy square of 2 x 2 m with 2 * side * side triangles.
Mesh carpet(unsigned side) {
  TriangleMesh mesh;
  for (unsigned i = 0; i <= side; ++i) {
    for (unsigned j = 0; j <= side; ++j) {
      const float x = 2.0F * static_cast<float>(i) / static_cast<float>(side) - 1;
      const float y = 2.0F * static_cast<float>(j) / static_cast<float>(side) - 1;
      mesh.vertices.push_back({x, y, 0.1F * std::sin(5 * x) * std::cos(4 * y)});
      if (i == side || j == side) continue;
      const unsigned corner = i * (side + 1) + j;
      mesh.triangles.push_back({corner, corner + side + 1, corner + 1});
      mesh.triangles.push_back({corner + 1, corner + side + 1, corner + side + 2});
    }
  }
  return Mesh{finish_mesh(std::move(mesh))};
}

TEST(FacesInView, OfMeshesHavePlacesInTheirTriangles) {
  const Traced traced(scene({still(model("Carpet", link_with(carpet(8))))}));
  const Eye eye(traced, pinhole(Pose(-1.5, 0, 1, 0, 0.7, 0)));
  int compared = 0;
  for (std::size_t row = 0; row < kRows; ++row) {
    const std::vector<rays::Tile> tiles = eye.tiles(row / kRowsOfTile * kRowsOfTile);
    for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
      if (tiles[tile].needs_rays) continue;
      const double down = static_cast<double>(row) + 0.5;
      const double right = static_cast<double>(tile * kPacket) + 0.5;
      const RTCHit16 faces = eye.by_faces(tiles[tile], down, right).data.hit;
      const RTCHit16 rays = eye.by_rays(down, right).data.hit;
      for (std::size_t i = 0; i < kPacket; ++i) {
        if (faces.geomID[i] == RTC_INVALID_GEOMETRY_ID || faces.primID[i] != rays.primID[i]) continue;
        ++compared;
        EXPECT_NEAR(faces.u[i], rays.u[i], 1e-3);
        EXPECT_NEAR(faces.v[i], rays.v[i], 1e-3);
      }
    }
  }
  EXPECT_GT(compared, 3000);
}

TEST(FacesInView, AreLeftToRaysInTilesOfManyTriangles) {
  for (const unsigned side : {40U, 60U}) {  // fewer and more triangles than are rasterized
    const Traced traced(scene({still(model("Carpet", link_with(carpet(side)))), floor()}));
    const Compared compared = expect_as_by_rays(traced, pinhole(Pose(-4, 0, 1, 0, 0.2, 0)));
    EXPECT_GT(compared.by_rays, 0);
    EXPECT_GT(compared.by_faces, 0);
  }
}

/// Rays from places on the ground and in the air to a light, sixteen close to each other.
void expect_shadows_as_by_rays(const Traced& traced, std::mt19937& random, const Vector3& to_light) {
  std::uniform_real_distribution<double> place(-12, 12);
  std::uniform_real_distribution<double> height(0, 10);
  rays::FacesInLight light;
  light.start(to_light, Vector3::Zero(), kPixels);
  traced.rays.collect(light);
  int known = 0;
  int shaded = 0;
  int differing = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3 start(place(random), place(random), i % 2 == 0 ? 0 : height(random));
    rays::RayPacket packet;
    packet.start(start, 0, std::numeric_limits<float>::infinity(), 1 + static_cast<std::size_t>(i) % kPacket);
    for (std::size_t ray = 0; ray < kPacket; ++ray) {
      const double along = 0.02 * static_cast<double>(ray);
      rays::aim(packet.data.ray, ray, start + Vector3(along, 0.3 * along, 0), to_light);
    }
    RTCRay16 by_faces = packet.data.ray;
    if (!light.shade(by_faces, packet.mask)) continue;
    ++known;
    traced.rays.occlude(packet.data.ray, packet.mask);
    for (std::size_t ray = 0; ray < kPacket; ++ray) {
      if (packet.mask.use[ray] == 0) continue;
      shaded += packet.data.ray.tfar[ray] < 0 ? 1 : 0;
      differing += (by_faces.tfar[ray] < 0) != (packet.data.ray.tfar[ray] < 0) ? 1 : 0;
    }
  }
  EXPECT_GT(known, 2500);
  EXPECT_GT(shaded, 1500);
  EXPECT_LE(differing, 3) << "only rays that touch an edge may differ";
}

TEST(FacesInLight, ShadeWhatRaysFindShaded) {
  std::mt19937 random(12);
  const Traced traced(clutter(random));
  for (const Vector3& to_light : {Vector3(0, 0, 1), Vector3(0.4, -0.3, 1), Vector3(-1, 0.1, 0.3)}) {
    expect_shadows_as_by_rays(traced, random, to_light.normalized());
  }
}

/// A ray up from a place, in the shadow of what is above it.
bool is_shaded(const rays::FacesInLight& light, const Vector3& place, bool& is_known) {
  rays::RayPacket packet;
  packet.start(place, 0, std::numeric_limits<float>::infinity(), 1);
  for (std::size_t i = 0; i < kPacket; ++i) rays::aim(packet.data.ray, i, place, Vector3::UnitZ());
  is_known = light.shade(packet.data.ray, packet.mask);
  return packet.data.ray.tfar[0] < 0;
}

TEST(FacesInLight, ShadeNothingFarFromAllShapes) {
  const Traced near(scene({still(model("Roof", link_with(Box{{2, 2, 1}}), at(3, 0, 5)))}));
  rays::FacesInLight light;
  light.start(Vector3::UnitZ(), Vector3::Zero(), kPixels);
  near.rays.collect(light);
  bool is_known = false;
  EXPECT_FALSE(is_shaded(light, {500, 0, 0}, is_known));
  EXPECT_TRUE(is_known);
  EXPECT_TRUE(is_shaded(light, {3, 0, 0}, is_known));
  EXPECT_FALSE(is_shaded(light, {3, 0, 6}, is_known));
}

TEST(FacesInLight, LeaveWhatIsFarInALargeSceneToRays) {
  const Traced wide(scene({still(model("Roof", link_with(Box{{2, 2, 1}}), at(100, 0, 5)))}));
  rays::FacesInLight light;
  light.start(Vector3::UnitZ(), Vector3::Zero(), kPixels);
  wide.rays.collect(light);
  bool is_known = true;
  is_shaded(light, {100, 0, 0}, is_known);
  EXPECT_FALSE(is_known);
  EXPECT_FALSE(is_shaded(light, {3, 0, 0}, is_known));
  EXPECT_TRUE(is_known);
}

TEST(FacesInLight, PassShapesThatCastNoShadow) {
  ModelDescription roof = still(model("Roof", link("link"), at(0, 0, 5)));
  VisualDescription glass;
  glass.geometry = Box{{2, 2, 1}};
  glass.cast_shadows = false;
  roof.links[0].visuals.push_back(glass);
  const Traced traced(scene({roof}));
  rays::FacesInLight light;
  light.start(Vector3::UnitZ(), Vector3::Zero(), kPixels);
  traced.rays.collect(light);
  bool is_known = false;
  EXPECT_FALSE(is_shaded(light, {0, 0, 0}, is_known));
  EXPECT_TRUE(is_known);
}

}  // namespace
}  // namespace bubblesim::test::test_faces
