// SPDX-License-Identifier: BSD-3-Clause
// What the objects of a file are for a simulation.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "load/ttt/groups.hpp"
#include "load/ttt/structure.hpp"
#include "ttt_writer.hpp"

namespace bubblesim::test::test_ttt_structure {
namespace {

using namespace bubblesim::ttt;
using namespace ttt_writer;

constexpr std::array<double, 7> kHere{1, 0, 0, 0, 0, 0, 0};
constexpr int kDynamicMode = 5;
constexpr int kKinematicMode = 0;

ObjectText moving(int handle, int parent) { return {"SHP", handle, parent, "moving", kHere, "", cuboid(kDynamic)}; }
ObjectText fixed(int handle, int parent) { return {"SHP", handle, parent, "fixed", kHere, "", cuboid(0)}; }
ObjectText joint_at(int handle, int parent, int mode = kDynamicMode, double position = 0) {
  return {"JNT", handle, parent, "joint", kHere, "", joint(mode, position)};
}
ObjectText dummy(int handle, int parent, int linked = -1) {
  return {"DMY", handle, parent, "dummy", kHere, "", item("Lli", ints({linked})) + item("Dl2", ints({0}))};
}
ObjectText force_sensor(int handle, int parent) { return {"FSE", handle, parent, "force", kHere}; }

struct Built {
  SceneFile file;
  Structure structure;
};
Built built(const std::vector<ObjectText>& objects) {
  Built result;
  result.file = read_scene_file(ttt_writer::file(objects));
  result.structure = structure_of(result.file);
  return result;
}

TEST(TttStructure, MakesABodyOfEachShapeThatIsNotStatic) {
  const Structure structure = built({fixed(1, -1), moving(2, -1), fixed(3, 2), dummy(4, 3)}).structure;
  ASSERT_EQ(structure.bodies.size(), 1U);
  EXPECT_EQ(structure.bodies[0].members, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(structure.nodes[0].body, kWorld);
}

TEST(TttStructure, LetsAShapeBelowAShapeFall) {
  const Structure structure = built({moving(1, -1), moving(2, 1)}).structure;
  EXPECT_EQ(structure.bodies.size(), 2U);
  EXPECT_TRUE(structure.connections.empty());
}

TEST(TttStructure, ConnectsByJointsInDynamicMode) {
  const Structure structure = built({moving(1, -1), joint_at(2, 1), moving(3, 2)}).structure;
  ASSERT_EQ(structure.connections.size(), 1U);
  EXPECT_EQ(structure.connections[0].object, 1);
  EXPECT_EQ(structure.connections[0].parent, 0);
  EXPECT_EQ(structure.connections[0].child, 1);
}

TEST(TttStructure, ConnectsNothingByJointsThatOnlyScriptsMove) {
  EXPECT_TRUE(built({moving(1, -1), joint_at(2, 1, kKinematicMode), moving(3, 2)}).structure.connections.empty());
}

TEST(TttStructure, ConnectsStaticShapesAsTheWorld) {
  const Structure structure = built({fixed(1, -1), joint_at(2, 1), moving(3, 2)}).structure;
  ASSERT_EQ(structure.connections.size(), 1U);
  EXPECT_EQ(structure.connections[0].parent, kWorld);
}

TEST(TttStructure, ConnectsByForceSensorsRigidly) {
  const Structure structure = built({moving(1, -1), force_sensor(2, 1), moving(3, 2)}).structure;
  ASSERT_EQ(structure.connections.size(), 1U);
  EXPECT_EQ(structure.connections[0].kind, ConnectionKind::kRigid);
}

TEST(TttStructure, ClosesALoopByTheJointThatADummyEnds) {
  const Structure structure =
      built({moving(1, -1), joint_at(2, 1), dummy(3, 2, 5), moving(4, -1), dummy(5, 4, 3)}).structure;
  ASSERT_EQ(structure.connections.size(), 1U);
  EXPECT_EQ(structure.connections[0].kind, ConnectionKind::kJoint);
  EXPECT_EQ(structure.connections[0].object, 1);
  EXPECT_EQ(structure.connections[0].child, 1);
}

TEST(TttStructure, WeldsBodiesOfLinkedDummiesOnce) {
  const Structure structure = built({moving(1, -1), dummy(2, 1, 4), moving(3, -1), dummy(4, 3, 2)}).structure;
  ASSERT_EQ(structure.connections.size(), 1U);
  EXPECT_EQ(structure.connections[0].kind, ConnectionKind::kWeld);
}

TEST(TttStructure, PlacesChildrenBeyondThePositionOfAJoint) {
  ObjectText arm = moving(2, 1);
  arm.pose = {1, 0, 0, 0, 1, 0, 0};
  const Structure structure = built({joint_at(1, -1, kDynamicMode, M_PI / 2), arm}).structure;
  EXPECT_NEAR(structure.nodes[1].world.position.x(), 0, 1e-12);
  EXPECT_NEAR(structure.nodes[1].world.position.y(), 1, 1e-12);
}

TEST(TttStructure, TakesChildrenBeforeTheirParents) {
  const Structure structure = built({dummy(1, 2), dummy(2, -1)}).structure;
  EXPECT_EQ(structure.roots, (std::vector<int>{1}));
  EXPECT_EQ(structure.nodes[1].children, (std::vector<int>{0}));
}

TEST(TttStructure, PutsObjectsWithImpossibleParentsAtTheTop) {
  const Structure missing = built({dummy(1, 77)}).structure;
  EXPECT_EQ(missing.roots.size(), 1U);
  const Structure itself = built({dummy(1, 1)}).structure;
  EXPECT_EQ(itself.roots.size(), 1U);
  const Structure circle = built({dummy(1, 2), dummy(2, 3), dummy(3, 1), dummy(4, 3)}).structure;
  EXPECT_EQ(circle.roots.size(), 1U);
}

TEST(TttStructure, KeepsWhatAModelForbids) {
  ObjectText model = dummy(1, -1);
  model.common = item("Va3", byte(1)) + item("Mpo", ints({0x120}));  // not dynamic, not visible
  const Structure structure = built({model, moving(2, 1)}).structure;
  EXPECT_TRUE(structure.bodies.empty());
  EXPECT_FALSE(structure.nodes[1].is_visible);
}

TEST(TttStructure, HidesObjectsOfOtherLayers) {
  ObjectText hidden = moving(1, -1);
  hidden.common = item("Lar", raw(std::uint16_t{0x100}));
  const Structure structure = built({hidden, moving(2, -1)}).structure;
  EXPECT_FALSE(structure.nodes[0].is_visible);
  EXPECT_TRUE(structure.nodes[1].is_visible);
}

TEST(TttGroups, MovesConnectedBodiesToTheZeroOfTheirJoints) {
  ObjectText arm = moving(3, 2);
  arm.pose = {1, 0, 0, 0, 1, 0, 0};
  const Built scene = built({moving(1, -1), joint_at(2, 1, kDynamicMode, M_PI / 2), arm});
  const auto groups = groups_of(scene.file, scene.structure);
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_NEAR(groups[0].at_zero.at(1).position.x(), 1, 1e-12);
  EXPECT_NEAR(groups[0].at_zero.at(1).position.y(), 0, 1e-12);
}

TEST(TttGroups, LeavesLoopsAsTheyAre) {
  const Built scene =
      built({moving(1, -1), joint_at(2, 1), moving(3, 2), dummy(4, 3, 6), joint_at(5, 1), dummy(6, 5, 4)});
  const auto groups = groups_of(scene.file, scene.structure);
  ASSERT_EQ(scene.structure.connections.size(), 2U);
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_TRUE(groups[0].at_zero.empty());
}

TEST(TttGroups, JoinsAnArmWithTheBaseThatHoldsIt) {
  const Built scene = built({fixed(1, -1), joint_at(2, 1), moving(3, 2), fixed(4, -1)});
  const auto groups = groups_of(scene.file, scene.structure);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].fixed, 0);
  EXPECT_EQ(groups[0].bodies, (std::vector<int>{0}));
  EXPECT_TRUE(groups[1].bodies.empty());
}

}  // namespace
}  // namespace bubblesim::test::test_ttt_structure
