// SPDX-License-Identifier: BSD-3-Clause
// Textures of CoppeliaSim's files that are projected on a mesh.
#include <gtest/gtest.h>

#include "load/ttt/scene_file.hpp"
#include "load/ttt/texture_projection.hpp"
#include "ttt_writer.hpp"

namespace bubblesim::test::test_ttt_textures {
namespace {

using namespace bubblesim::ttt;
using namespace ttt_writer;
using Coordinates = std::vector<std::array<float, 2>>;

Part triangle(const Vertices& corners) {
  Part part;
  part.vertices = std::make_shared<const Vertices>(corners);
  part.triangles = std::make_shared<const Triangles>(Triangles{{0, 1, 2}});
  return part;
}

TEST(TttProjection, OnAPlaneHasTheMiddleOfTheImageAtItsOrigin) {
  Projection projection;
  projection.size = {2, 4};
  const Part part = triangle({{-1, -2, 0}, {1, -2, 5}, {0, 2, 0}});
  EXPECT_EQ(projected(part, projection), (Coordinates{{0, 0}, {1, 0}, {0.5, 1}}));
}

TEST(TttProjection, FollowsItsFrameAndThatOfTheVertices) {
  Projection projection;
  projection.frame = Pose(0, 0, 1, M_PI / 2, 0, 0);  // its y axis points upwards
  Part part = triangle({{0, 0, 1}, {0.25, 7, 1}, {0, 0, 1.5}});
  part.frame = Pose(0.25, 0, 0, 0, 0, 0);
  const Coordinates found = projected(part, projection);
  const Coordinates expected{{0.75, 0.5}, {1, 0.5}, {0.75, 1}};
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i][0], expected[i][0], 1e-6);
    EXPECT_NEAR(found[i][1], expected[i][1], 1e-6);
  }
}

TEST(TttProjection, OnACubeIsUprightOnEachSideSeenFromOutside) {
  Projection projection;
  projection.mode = ProjectionMode::kCube;
  const auto right_and_up = [&](const Vertices& corners) {
    const Coordinates c = projected(triangle(corners), projection);
    return c[1][0] > c[0][0] && c[2][1] > c[0][1];  // the second corner is to the right, the third above
  };
  constexpr float s = 0.2F;
  EXPECT_TRUE(right_and_up({{s, 0, 0}, {s, s, 0}, {s, 0, s}}));
  EXPECT_TRUE(right_and_up({{-s, 0, 0}, {-s, -s, 0}, {-s, 0, s}}));
  EXPECT_TRUE(right_and_up({{0, s, 0}, {-s, s, 0}, {0, s, s}}));
  EXPECT_TRUE(right_and_up({{0, -s, 0}, {s, -s, 0}, {0, -s, s}}));
  EXPECT_TRUE(right_and_up({{0, 0, s}, {s, 0, s}, {0, s, s}}));
}

TEST(TttProjection, OfAnImageThatDoesNotRepeatMustCoverTheMesh) {
  Projection projection;
  const Part part = triangle({{0, 0, 0}, {2, 0, 0}, {0, 0.25, 0}});
  EXPECT_TRUE(projected(part, projection).empty());
  projection.repeats = {true, false};
  EXPECT_EQ(projected(part, projection), (Coordinates{{0.5, 0.5}, {2.5, 0.5}, {0.5, 0.75}}));
}

TEST(TttProjection, IsReadWithTheMesh) {
  const std::string body = item("_as", doubles({2}));
  const std::string texture = item("_ob", ints({77, 0}) + doubles({2, 2})) + item("Bs2", byte(0xd)) + item("Ftc", "") +
                              item("Apm", ints({1})) + "EOO";
  const std::string mesh =
      item("Ver", floats({-1, -1, 0, 1, -1, 0, 1, 1, 0})) + item("Ind", ints({0, 1, 2})) + item("Toj", texture);
  const std::string own = item("Ge2", item("Gst", body + "EOO" + mesh + "EOO") + "EOO");
  const SceneFile scene = read_scene_file(file({{"SHP", 1, -1, "floor", {1, 0, 0, 0, 0, 0, 0}, "", own}}));
  const Part& part = scene.objects.at(0).as<Shape>()->parts.at(0);
  EXPECT_EQ(part.texture, 77);
  EXPECT_TRUE(part.is_decal);
  EXPECT_EQ(part.texture_coordinates, (Coordinates{{0, 0}, {1, 0}, {1, 1}}));
}

}  // namespace
}  // namespace bubblesim::test::test_ttt_textures
