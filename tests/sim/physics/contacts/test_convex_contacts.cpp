// SPDX-License-Identifier: BSD-3-Clause
// Moving meshes on each other, on planes and on terrain: stacks stand, and nothing gains energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "bubblesim/world.hpp"
#include "meshes/made_meshes.hpp"
#include "physics/convex/collision_mesh.hpp"
#include "polyhedra.hpp"
#include "scenes.hpp"
#include "surfaces.hpp"

namespace bubblesim::test::test_convex_contacts {
namespace {

constexpr double kStep = 0.005;

/// A body with the inertia of a solid cube of 0.2 m and 1 kg.
ModelDescription solid(const std::string& name, const Geometry& geometry, const Pose& pose) {
  ModelDescription described = model(name, link_with(geometry), pose);
  described.links[0].inertia_diagonal = Vector3::Ones() * (0.2 * 0.2 / 6);
  return described;
}

SceneDescription stack(const std::vector<Geometry>& shapes, double side) {
  std::vector<ModelDescription> models{floor()};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    models.push_back(solid("Cube" + std::to_string(i), shapes[i], at(0, 0, side * (static_cast<double>(i) + 0.5))));
  }
  return scene(std::move(models));
}

/// Greatest distance of a cube of a stack from its place during a minute.
double most_moved(const SceneDescription& described, double side) {
  World world(described, 0);
  double most = 0;
  for (int second = 0; second < 60; ++second) {
    world.advance(1, kStep);
    for (std::size_t i = 1; i < described.models.size(); ++i) {
      const Vector3 place = world.pose(world.tree().find("/Cube" + std::to_string(i - 1))).position;
      most = std::max(most, (place - Vector3(0, 0, side * (static_cast<double>(i) - 0.5))).norm());
    }
  }
  return most;
}

TEST(ConvexStack, OfTwoMeshCubesStaysWithinAMillimetre) {
  const Geometry cube_mesh = box_mesh({0.2, 0.2, 0.2});
  EXPECT_LT(most_moved(stack({cube_mesh, cube_mesh}, 0.2), 0.2), 0.001);
}

TEST(ConvexStack, OfFourMeshCubesStaysWithinFiveMillimetres) {
  const Geometry cube_mesh = box_mesh({0.2, 0.2, 0.2});
  EXPECT_LT(most_moved(stack({cube_mesh, cube_mesh, cube_mesh, cube_mesh}, 0.2), 0.2), 0.005);
}

TEST(ConvexStack, OfMeshesAndBoxesStandsAsWell) {
  const Geometry cube_mesh = box_mesh({0.2, 0.2, 0.2});
  const Geometry box = Box{{0.2, 0.2, 0.2}};
  EXPECT_LT(most_moved(stack({cube_mesh, box, cube_mesh}, 0.2), 0.2), 0.005);
}

/// Kinetic and potential energy of bodies of 1 kg with equal moments of inertia, J.
double energy(const World& world, int count) {
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const ObjectId body = world.tree().find("/Body" + std::to_string(i));
    const Twist velocity = world.velocity(body);
    sum += velocity.linear.squaredNorm() / 2 + 0.2 * 0.2 / 6 * velocity.angular.squaredNorm() / 2 +
           9.81 * world.pose(body).position.z();
  }
  return sum;
}

/// An L of 0.2 m, 0.07 m thick, about its centre of mass.
Mesh angle_iron() {
  const Outline outline = {{0, 0}, {0.2, 0}, {0.2, 0.07}, {0.07, 0.07}, {0.07, 0.2}, {0, 0.2}};
  TriangleMesh mesh = *extrude({{outline, 0.1}});
  for (TriangleMesh::Point& vertex : mesh.vertices)
    vertex = {vertex[0] - 0.075F, vertex[1] - 0.075F, vertex[2] - 0.05F};
  return Mesh{finish_mesh(std::move(mesh))};
}

/// Hills of 5 cm over 4 m, of triangles of 10 cm, in a bowl that keeps bodies in.
Mesh hills() {
  Heights heights{41, 41, {}};
  for (int row = 0; row < 41; ++row) {
    for (int column = 0; column < 41; ++column) {
      const double x = (column - 20) * 0.1;
      const double y = (row - 20) * 0.1;
      heights.values.push_back(
          static_cast<float>(0.05 + 0.05 * std::sin(5 * x) * std::cos(4 * y) + 0.2 * (x * x + y * y)));
    }
  }
  return Mesh{raise_ground(heights, {4, 4, *std::max_element(heights.values.begin(), heights.values.end())})};
}

/// Drops 20 bodies of some kinds in random poses, and checks that none goes up or through the ground.
void drop(const std::vector<Geometry>& kinds, const ModelDescription& ground, unsigned seed) {
  constexpr int kCount = 20;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> side(-0.3, 0.3);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  std::vector<ModelDescription> models{ground};
  for (int i = 0; i < kCount; ++i) {
    models.push_back(
        solid("Body" + std::to_string(i), kinds[static_cast<std::size_t>(i) % kinds.size()],
              Pose(side(random), side(random), 0.6 + 0.15 * i, angle(random), angle(random), angle(random))));
  }
  World world(scene(std::move(models)), seed);
  double before = energy(world, kCount);
  for (int i = 0; i < 100; ++i) {
    world.advance(0.05, kStep);
    const double now = energy(world, kCount);
    // Pushing shapes apart that overlap by a few millimetres lifts them.
    EXPECT_LT(now, before + 0.05) << "at " << 0.05 * (i + 1) << " s, seed " << seed;
    before = now;
  }
  for (int i = 0; i < kCount; ++i) {
    const ObjectId body = world.tree().find("/Body" + std::to_string(i));
    EXPECT_GT(world.pose(body).position.z(), 0.02) << i;
    EXPECT_LT(world.velocity(body).linear.norm(), 0.5) << i;
  }
}

TEST(ConvexDrop, PolyhedraComeToRestOnAPlaneAndOnEachOther) {
  drop({Mesh{hull_mesh(icosahedron(0.12))}, Mesh{hull_mesh(tetrahedron(0.15))}, box_mesh({0.2, 0.15, 0.1})}, floor(),
       1);
}

TEST(ConvexDrop, PolyhedraComeToRestOnTerrain) {
  drop({Mesh{hull_mesh(icosahedron(0.12))}, Mesh{hull_mesh(tetrahedron(0.15))}, box_mesh({0.2, 0.15, 0.1})},
       still(model("Ground", link_with(hills()))), 2);
}

TEST(ConvexDrop, PolyhedraComeToRestAmongPrimitives) {
  drop({Mesh{hull_mesh(octahedron(0.14))}, Box{{0.2, 0.1, 0.15}}, Sphere{0.1}, Capsule{0.06, 0.15},
        Cylinder{0.08, 0.15}},
       still(model("Ground", link_with(hills()))), 3);
}

TEST(ConvexDrop, ConcaveMeshesComeToRest) {
  const Mesh iron = angle_iron();
  drop({iron}, floor(), 4);
  drop({iron, Mesh{hull_mesh(icosahedron(0.12))}, Box{{0.2, 0.1, 0.15}}}, still(model("Ground", link_with(hills()))),
       5);
}

TEST(ConvexContact, AnLCollidesAsTheDescriptionStates) {
  const Mesh iron = angle_iron();
  const auto prepared = [&](MeshUse use) { return collision_mesh(iron.triangles, use); };
  EXPECT_EQ(prepared(MeshUse::kMoving)->parts.size(), 2U);
  EXPECT_EQ(prepared(MeshUse::kParts)->parts.size(), 2U);
  EXPECT_EQ(prepared(MeshUse::kHull)->parts.size(), 1U);
  EXPECT_TRUE(prepared(MeshUse::kStatic)->parts.empty());
  EXPECT_EQ(prepared(MeshUse::kTriangles)->indices.size(), iron.triangles->triangles.size() * 3);
  // A ball falls into the corner of the L, but stays above its hull.
  const auto height = [&](MeshCollision collision) {
    ModelDescription fixed = still(model("Iron", link_with(iron), Pose(0, 0, 0, M_PI / 2, 0, 0)));
    fixed.links[0].collisions[0].mesh_collision = collision;
    World world(scene({fixed, solid("Ball", Sphere{0.02}, at(0.02, 0, 0.12))}), 0);
    world.advance(0.2, kStep);
    return world.pose(world.tree().find("/Ball")).position.z();
  };
  EXPECT_NEAR(height(MeshCollision::kAuto), -0.005 + 0.02, 0.003);
  EXPECT_NEAR(height(MeshCollision::kParts), -0.005 + 0.02, 0.003);
  EXPECT_GT(height(MeshCollision::kHull), 0.03);
}

TEST(ConvexContact, DoesNotCatchOnTheEdgesInsideAGround) {
  // A cube slides with friction mu on triangles of 5 cm: it stops after v^2 / (2 mu g).
  const auto flat = raise_ground(Heights{201, 21, std::vector<float>(201 * 21, 0.0F)}, {10, 1, 0});
  ModelDescription slider = solid("Slider", box_mesh({0.2, 0.2, 0.1}), at(-4, 0.013, 0.05));
  slider.links[0].collisions[0].surface.mu = 0.5;
  World world(scene({still(model("Ground", link_with(Mesh{flat}))), slider}), 0);
  const ObjectId id = world.tree().find("/Slider");
  world.advance(0.2, kStep);
  const Vector3 start = world.pose(id).position;
  world.set_velocity(id, {{4, 0, 0}, {}});
  double highest = 0;
  for (int i = 0; i < 300; ++i) {
    world.advance(kStep, kStep);
    highest = std::max(highest, world.pose(id).position.z());
  }
  EXPECT_NEAR(world.pose(id).position.x() - start.x(), 4 * 4 / (2 * 0.5 * 9.81), 0.03);
  EXPECT_LT(highest, 0.051);
}

}  // namespace
}  // namespace bubblesim::test::test_convex_contacts
