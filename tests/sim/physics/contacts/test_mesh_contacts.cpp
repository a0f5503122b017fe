// SPDX-License-Identifier: BSD-3-Clause
// Capsules, ellipsoids and meshes: resting, rolling and sliding.
#include <gtest/gtest.h>

#include <cmath>

#include "bubblesim/world.hpp"
#include "meshes/finish_mesh.hpp"
#include "meshes/made_meshes.hpp"
#include "physics/convex/collision_mesh.hpp"
#include "scenes.hpp"
#include "surfaces.hpp"

namespace bubblesim::test::test_mesh_contacts {
namespace {

constexpr double kStep = 0.005;
constexpr double kLayer = 0.001;  // m, allowed penetration

ModelDescription solid(const char* name, const Geometry& geometry, const Pose& pose) {
  ModelDescription described = model(name, link_with(geometry), pose);
  described.links[0].inertia_diagonal = Vector3::Ones() * 0.01;
  return described;
}

/// Position and velocity of a body after two seconds.
struct Rest {
  Pose pose;
  Twist velocity;
};
Rest after_two_seconds(const Geometry& geometry, const Pose& pose, const ModelDescription& ground) {
  World world(scene({ground, solid("Thing", geometry, pose)}), 0);
  world.advance(2, kStep);
  const ObjectId thing = world.tree().find("/Thing");
  return {world.pose(thing), world.velocity(thing)};
}

void expect_at_rest(const Rest& rest, double height) {
  EXPECT_NEAR(rest.pose.position.z(), height, 3 * kLayer);
  EXPECT_LT(std::hypot(rest.pose.position.x(), rest.pose.position.y()), 0.01);
  EXPECT_LT(rest.velocity.linear.norm(), 1e-3);
  EXPECT_LT(rest.velocity.angular.norm(), 1e-2);
}

/// Grounds with their surface at z = 0.
std::vector<ModelDescription> grounds() {
  return {floor(), still(model("Table", link_with(Box{{4, 4, 1}}), at(0, 0, -0.5))),
          still(model("Mesa", link_with(box_mesh({4, 4, 1})), at(0, 0, -0.5)))};
}

TEST(MeshContact, ABoxOfTrianglesRestsAsABoxDoes) {
  for (const ModelDescription& ground : grounds()) {
    expect_at_rest(after_two_seconds(box_mesh({0.4, 0.3, 0.2}), at(0, 0, 0.12), ground), 0.1);
    expect_at_rest(after_two_seconds(Box{{0.4, 0.3, 0.2}}, at(0, 0, 0.12), ground), 0.1);
  }
}

/// A square of 1 m about the origin, of 2 n^2 triangles; `height` is the height at each point.
template <class Height>
std::shared_ptr<const TriangleMesh> fine_ground(std::uint32_t n, const Height& height) {
  TriangleMesh mesh;
  for (std::uint32_t row = 0; row <= n; ++row) {
    for (std::uint32_t column = 0; column <= n; ++column) {
      const float x = static_cast<float>(column) / static_cast<float>(n) - 0.5F;
      const float y = static_cast<float>(row) / static_cast<float>(n) - 0.5F;
      mesh.vertices.push_back({x, y, height(x, y)});
      if (row == n || column == n) continue;
      const std::uint32_t a = row * (n + 1) + column;
      mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, a + n + 2}, {a, a + n + 2, a + n + 1}});
    }
  }
  return finish_mesh(std::move(mesh));
}

TEST(MeshContact, AThingRestsOnASurfaceThatIsTooFineToCollideWith) {
  const auto flat = fine_ground(300, [](float, float) { return 0.0F; });
  expect_at_rest(after_two_seconds(Box{{0.4, 0.3, 0.2}}, at(0, 0, 0.12), still(model("Fine", link_with(Mesh{flat})))),
                 0.1);
}

TEST(MeshContact, ASurfaceThatIsTooFineIsSimplifiedWithinAMillimetre) {
  const auto wave = [](float x, float y) { return 0.05F * std::sin(6 * x) * std::cos(5 * y); };
  const auto coarse = collision_mesh(fine_ground(300, wave), MeshUse::kStatic);
  EXPECT_LE(coarse->indices.size(), 3U * 4 * 3000) << "four cells of a metre meet at the origin";
  EXPECT_NE(coarse->remark.find("180000 triangles"), std::string::npos) << coarse->remark;
  for (std::size_t i = 0; i < coarse->indices.size(); i += 3) {
    Vector3 middle;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const double* place = &coarse->coordinates[3 * coarse->indices[i + corner]];
      middle += Vector3(place[0], place[1], place[2]) / 3;
    }
    EXPECT_NEAR(middle.z(), wave(static_cast<float>(middle.x()), static_cast<float>(middle.y())), 0.001);
  }
  const auto fine = collision_mesh(fine_ground(60, wave), MeshUse::kStatic);
  EXPECT_EQ(fine->indices.size(), 3U * 2 * 60 * 60);
  EXPECT_EQ(fine->remark, "");
}

TEST(MeshContact, EveryShapeRestsOnTriangles) {
  const ModelDescription mesa = grounds().back();
  expect_at_rest(after_two_seconds(Sphere{0.2}, at(0, 0, 0.22), mesa), 0.2);
  expect_at_rest(after_two_seconds(Cylinder{0.2, 0.4}, at(0, 0, 0.22), mesa), 0.2);
  expect_at_rest(after_two_seconds(Capsule{0.1, 0.4}, Pose(0, 0, 0.12, 0, M_PI / 2, 0), mesa), 0.1);
}

TEST(MeshContact, AManySidedPrismStandsStill) {
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < 64; ++i) outline.emplace_back(0.2 * std::cos(M_PI * i / 32), 0.2 * std::sin(M_PI * i / 32));
  const Mesh prism{extrude({{outline, 0.2}})};
  for (const ModelDescription& ground : grounds()) {
    expect_at_rest(after_two_seconds(prism, at(0, 0, 0.01), ground), 0);
  }
}

TEST(MeshContact, AConcaveThingKeepsItsHollow) {
  // An arch: a ball of 0.15 m fits below it.
  const std::vector<Eigen::Vector2d> outline = {{-0.4, 0}, {-0.3, 0}, {-0.3, 0.4}, {0.3, 0.4},
                                                {0.3, 0},  {0.4, 0},  {0.4, 0.5},  {-0.4, 0.5}};
  ModelDescription arch =
      model("Arch", link_with(Mesh{extrude({{outline, 0.4}})}), Pose(0, 0.2, 0.002, M_PI / 2, 0, 0));
  arch.links[0].centre_of_mass = {0, 0.3, 0.2};
  World world(scene({floor(), arch, solid("Ball", Sphere{0.15}, at(0, 0, 0.16))}), 0);
  world.advance(2, kStep);
  EXPECT_NEAR(world.pose(world.tree().find("/Ball")).position.z(), 0.15, 3 * kLayer);
  EXPECT_NEAR(world.pose(world.tree().find("/Arch")).position.z(), 0, 5 * kLayer);
}

TEST(MeshContact, ABallRollsDownASlopeOfTrianglesAsOnABox) {
  // Rolling without slipping: a = 5/7 g sin(angle).
  const double angle = 0.1;
  const Quaternion tilt = from_rpy(0, angle, 0);
  for (const Geometry& geometry : {Geometry(box_mesh({20, 4, 1})), Geometry(Box{{20, 4, 1}})}) {
    const ModelDescription slope = still(model("Slope", link_with(geometry), Pose(Vector3::Zero(), tilt)));
    ModelDescription ball = model("Ball", link_with(Sphere{0.1}), Pose(tilt * Vector3(0, 0, 0.6), tilt));
    ball.links[0].inertia_diagonal = Vector3::Ones() * 0.4 * 0.1 * 0.1;
    World world(scene({slope, ball}), 0);
    world.advance(1, kStep);
    const double acceleration = 5.0 / 7 * 9.81 * std::sin(angle);
    const Vector3 way = world.pose(world.tree().find("/Ball")).position - ball.pose.position;
    EXPECT_NEAR(way.norm(), acceleration / 2, 0.02 * acceleration);
  }
}

TEST(MeshContact, AnEllipsoidOfEqualRadiiIsASphere) {
  expect_at_rest(after_two_seconds(Ellipsoid{{0.2, 0.2, 0.2}}, at(0, 0, 0.2), floor()), 0.2);
}

TEST(MeshContact, AnEllipsoidComesToRestOnItsFlatSide) {
  const Rest rest = after_two_seconds(Ellipsoid{{0.4, 0.4, 0.1}}, at(0, 0, 0.11), floor());
  EXPECT_NEAR(rest.pose.position.z(), 0.1, 3 * kLayer);
}

TEST(MeshContact, GroundFromHeightsHoldsABallInItsValley) {
  // A V along y, 1 m deep over 2 m: a ball of radius r touches both slopes, its centre is r * sqrt(2) above the bottom.
  const auto ground = raise_ground(Heights{3, 2, {1, 0, 1, 1, 0, 1}}, {2, 2, 1});
  const Rest rest = after_two_seconds(Sphere{0.1}, at(0, 0, 0.2), still(model("Valley", link_with(Mesh{ground}))));
  EXPECT_NEAR(rest.pose.position.z(), 0.1 * std::sqrt(2.0), 3 * kLayer);
}

TEST(MeshContact, IsTheSameInEveryRun) {
  const auto run = [] {
    World world(scene({grounds().back(), solid("Thing", box_mesh({0.4, 0.3, 0.2}), Pose(0, 0, 0.5, 0.3, 0.4, 0.5))}),
                0);
    world.advance(2, kStep);
    return world.state_hash();
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace bubblesim::test::test_mesh_contacts
