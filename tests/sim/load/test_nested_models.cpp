// SPDX-License-Identifier: BSD-3-Clause
// Nested models: names, frames, joints between them, motion.
#include <gtest/gtest.h>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"
#include "scene_files.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_nested_models {
namespace {

/// A cart with a nested arm model, which has a nested hand; rotated and moved, so that frames matter.
constexpr const char* kCart = R"(
  <model name='Cart'>
    <pose>1 0 1 0 0 1.5707963267948966</pose>
    <frame name='mount'><pose>0 0 0.5 0 0 0</pose></frame>
    <link name='body'><inertial><mass>10</mass></inertial></link>
    <model name='Arm'>
      <pose relative_to='mount'>0.2 0 0 0 0 0</pose>
      <link name='upper'/>
      <model name='Hand'>
        <pose>0.3 0 0 0 0 0</pose>
        <link name='palm'>
          <sensor name='Eye' type='sonar'><sonar><min>0</min><max>2</max><radius>0</radius></sonar></sensor>
        </link>
      </model>
      <joint name='wrist' type='fixed'><parent>upper</parent><child>Hand::palm</child></joint>
    </model>
    <joint name='shoulder' type='revolute'>
      <parent>body</parent><child>Arm::upper</child>
      <axis><xyz>0 0 1</xyz><bubblesim:motor>velocity</bubblesim:motor></axis>
    </joint>
  </model>)";

class NestedModels : public ::testing::Test {
 protected:
  TemporaryFile file_{"cart.sdf", in_world("<gravity>0 0 0</gravity>" + std::string(kCart))};
  World world_{read_scene(file_.path()), 0};

  ObjectId find(const char* path) const { return world_.tree().find(path); }
};

TEST_F(NestedModels, HaveTheirPathsInTheTree) {
  EXPECT_EQ(world_.tree().path(find("/Cart/Arm/Hand/palm")), "/Cart/Arm/Hand/palm");
  EXPECT_EQ(world_.tree().path(find("/wrist")), "/Cart/Arm/wrist");
  EXPECT_EQ(world_.tree().path(find("/Eye")), "/Cart/Arm/Hand/palm/Eye");
  EXPECT_EQ(world_.tree().find("::", find("/palm")), find("/Cart/Arm")) << "the model of its model";
  EXPECT_EQ(world_.tree().outermost_model_of(find("/palm")), find("/Cart"));
}

TEST_F(NestedModels, StandInTheFramesThatTheyName) {
  // The cart is rotated by a quarter turn: its x is the world's y.
  EXPECT_LT((world_.pose(find("/Arm")).position - Vector3(1, 0.2, 1.5)).norm(), 1e-9);
  EXPECT_LT((world_.pose(find("/palm")).position - Vector3(1, 0.5, 1.5)).norm(), 1e-9);
  EXPECT_LT((world_.pose(find("/shoulder")).position - Vector3(1, 0.2, 1.5)).norm(), 1e-9);
}

TEST_F(NestedModels, AreJoinedAcrossTheirBorders) {
  world_.joints().set_target_velocity(find("/shoulder"), 0.5);
  world_.advance(2, 0.005);
  EXPECT_NEAR(turn_about(Vector3::UnitZ(), world_.pose(find("/body")), world_.pose(find("/palm"))), 1, 0.02);
  EXPECT_NEAR((world_.pose(find("/palm")).position - world_.pose(find("/upper")).position).norm(), 0.3, 1e-3);
}

TEST_F(NestedModels, AreMovedAlone) {
  const Pose body = world_.pose(find("/body"));
  world_.set_pose(find("/Arm"), Pose(4, 5, 6, 0, 0, 0));
  EXPECT_EQ(world_.pose(find("/body")), body);
  EXPECT_LT((world_.pose(find("/palm")).position - Vector3(4.3, 5, 6)).norm(), 1e-9);
}

TEST_F(NestedModels, AreRemovedWithTheirOutermostModelOnly) {
  EXPECT_THROW(world_.models().remove(find("/Arm")), InvalidInput);
  world_.models().remove(find("/Cart"));
  EXPECT_THROW(find("/palm"), NoSuchObject);
}

TEST_F(NestedModels, AreBuiltAnewByAReset) {
  const std::uint64_t before = world_.state_hash();
  world_.joints().set_target_velocity(find("/shoulder"), 0.5);
  world_.advance(1, 0.005);
  world_.reset();
  EXPECT_EQ(world_.state_hash(), before);
}

TEST_F(NestedModels, HaveSensorsThatWork) {
  Simulation simulation(read_scene(file_.path()));
  EXPECT_FALSE(simulation.measure_proximity(simulation.world().tree().find("/Eye")).detected);
}

TEST(NestedModel, ThatIsStaticHoldsInTheWorld) {
  const TemporaryFile file("held.sdf",
                           in_world("<model name='m'><link name='a'/><model name='post'><static>true</static>"
                                    "<pose>0 0 2 0 0 0</pose><link name='l'/></model></model>"));
  World world(read_scene(file.path()), 0);
  world.advance(1, 0.005);
  EXPECT_NEAR(world.pose(world.tree().find("/post")).position.z(), 2, 1e-6);
  EXPECT_LT(world.pose(world.tree().find("/m/a")).position.z(), -4) << "the rest falls";
}

TEST(NestedModel, MergedByAnIncludeIsPartOfItsParent) {
  const TemporaryFile inner("model.sdf", "<sdf version='1.9'><model name='inner'><link name='l'/></model></sdf>");
  const std::string include = "<include merge='true'><uri>file://" + inner.path() + "</uri></include>";
  const TemporaryFile file("outer.sdf", in_world("<model name='m'><link name='a'/>" + include + "</model>"));
  const World world(read_scene(file.path()), 0);
  EXPECT_EQ(world.tree().path(world.tree().find("/l")), "/m/l");
}

TEST(NestedModel, ProblemsNameItsPathAndLine) {
  const TemporaryFile file("bad.sdf",
                           in_world("<model name='m'><link name='a'/><model name='inner'>\n"
                                    "<link name='l'><collision name='c'><geometry><sphere><radius>-1</radius></sphere>"
                                    "</geometry></collision></link>"
                                    "</model></model>"));
  try {
    read_scene(file.path());
    FAIL();
  } catch (const SceneError& error) {
    ASSERT_FALSE(error.problems.empty());
    EXPECT_EQ(error.problems[0].object, "/m/inner/l/c") << error.what();
    EXPECT_EQ(error.problems[0].line, 2);
  }
}

}  // namespace
}  // namespace bubblesim::test::test_nested_models
