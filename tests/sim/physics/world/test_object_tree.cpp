// SPDX-License-Identifier: BSD-3-Clause
// A tree of objects that is not the nesting of models: a joint is the parent of the link that it moves, frames are
// objects, sensors hang on frames. Expected poses are computed by hand from the description.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "bubblesim/world.hpp"
#include "near.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_object_tree {
namespace {

TreePlace place(int id, int parent, int order = 0, bool is_model = false) { return {id, parent, order, is_model}; }

FrameDescription frame(const std::string& name, FrameKind kind, const std::string& link, const Pose& pose,
                       const TreePlace& where) {
  FrameDescription made;
  made.name = name;
  made.kind = kind;
  made.link = link;
  made.pose = pose;
  made.place = where;
  return made;
}

/// /base {motor {wheel {rim}, hub}, post {eye}, cargo}, /path {mark}: the cargo is a body that nothing connects.
SceneDescription tree_scene() {
  ModelDescription robot = model("body", link("base", {0, 0, 0}), Pose(1, 2, 0, 0, 0, M_PI / 2));
  robot.links.push_back(link("wheel", {0.5, 0, 0}));
  robot.joints.push_back(joint("revolute", {axis(Vector3::UnitZ(), MotorMode::kNone)}, {0.5, 0, 0}));
  robot.joints[0].name = "motor";
  robot.joints[0].parent = "base";
  robot.joints[0].child = "wheel";
  robot.is_object = false;
  robot.links[0].place = place(10, -1, 0, true);
  robot.joints[0].place = place(11, 10, 0);
  robot.links[1].place = place(12, 11, 0);
  robot.frames = {frame("rim", FrameKind::kShape, "wheel", Pose(0.1, 0, 0, 0, 0, 0), place(13, 12)),
                  frame("hub", FrameKind::kDummy, "wheel", Pose(0, 0.2, 0, 0, 0, 0), place(14, 11, 1)),
                  frame("post", FrameKind::kDummy, "base", Pose(0, 0, 1, 0, 0, 0), place(15, 10, 1))};
  SensorDescription eye;
  eye.name = "eye";
  eye.pose = Pose(0, 0, 1.5, 0, 0, 0);
  eye.kind = SonarDescription{0, 2, 0.1};
  eye.place = place(16, 15);
  robot.links[0].sensors.push_back(eye);

  ModelDescription cargo = model("cargo body", link("cargo", {0, 0, 0}), Pose(1, 2, 3, 0, 0, 0));
  cargo.is_object = false;
  cargo.links[0].place = place(17, 10, 2);
  SceneDescription described = scene({robot, cargo}, Vector3::Zero());
  described.frames = {frame("mark", FrameKind::kDummy, "", Pose(4, 1, 0, 0, 0, 0), place(21, 20)),
                      frame("path", FrameKind::kDummy, "", Pose(4, 0, 0, 0, 0, 0), place(20, -1, 1))};
  return described;
}

std::vector<std::string> names(const SceneTree& tree, const std::vector<ObjectId>& objects) {
  std::vector<std::string> found;
  for (const ObjectId id : objects) found.push_back(tree.at(id).alias);
  return found;
}

class ObjectTree : public ::testing::Test {
 protected:
  ObjectId find(const std::string& path, ObjectId from = kNoObject) const { return world.tree().find(path, from); }
  std::vector<std::string> children(const std::string& path) const {
    return names(world.tree(), world.tree().children(path == "/" ? kNoObject : find(path)));
  }

  World world{tree_scene(), 0};
  ObjectId base = find("/base");
  ObjectId wheel = find("/wheel");
};

using Names = std::vector<std::string>;

TEST_F(ObjectTree, IsThatOfThePlacesInTheirOrder) {
  EXPECT_EQ(children("/"), (Names{"base", "path"}));
  EXPECT_EQ(children("/base"), (Names{"motor", "post", "cargo"}));
  EXPECT_EQ(children("/base/motor"), (Names{"wheel", "hub"}));
  EXPECT_EQ(children("/base/motor/wheel"), (Names{"rim"}));
  EXPECT_EQ(children("/base/post"), (Names{"eye"}));
  EXPECT_EQ(children("/path"), (Names{"mark"}));
}

TEST_F(ObjectTree, HasPathsThroughJoints) {
  EXPECT_EQ(world.tree().path(find("/rim")), "/base/motor/wheel/rim");
  EXPECT_EQ(world.tree().path(find("/eye")), "/base/post/eye");
  EXPECT_EQ(find("./wheel", find("/motor")), wheel);
  EXPECT_EQ(find("../../post", wheel), find("/post"));
  EXPECT_EQ(find(":/eye", find("/rim")), find("/eye"));
}

TEST_F(ObjectTree, LeavesModelsThatAreNoObjectsOut) {
  EXPECT_THROW(find("/body"), NoSuchObject);
  EXPECT_THROW(find("/cargo body"), NoSuchObject);
  EXPECT_EQ(world.tree().model_base_of(find("/rim")), base);
  // The physical structure knows them.
  const ObjectId body = world.tree().models().front();
  EXPECT_EQ(world.tree().outermost_model_of(find("/rim")), body);
  EXPECT_EQ(world.tree().outermost_model_of(find("/mark")), kNoObject);
  EXPECT_EQ(names(world.tree(), world.tree().parts(body, ObjectKind::kLink)), (Names{"base", "wheel"}));
  EXPECT_EQ(names(world.tree(), world.tree().parts(body, ObjectKind::kFrame)), (Names{"rim", "hub", "post"}));
  EXPECT_EQ(names(world.tree(), world.tree().parts(body, ObjectKind::kSensor)), (Names{"eye"}));
}

TEST_F(ObjectTree, PutsFramesWhereTheirLinkIs) {
  // The robot is turned by a quarter about z: its x axis is the world's y axis.
  expect_near(world.pose(find("/rim")), Pose(1, 2.6, 0, 0, 0, M_PI / 2), 1e-12);
  expect_near(world.pose(find("/hub")), Pose(0.8, 2.5, 0, 0, 0, M_PI / 2), 1e-12);
  expect_near(world.pose(find("/post")), Pose(1, 2, 1, 0, 0, M_PI / 2), 1e-12);
  expect_near(world.pose(find("/eye")), Pose(1, 2, 1.5, 0, 0, M_PI / 2), 1e-12);
  expect_near(world.pose(find("/mark")), Pose(4, 1, 0, 0, 0, 0), 1e-12);
}

TEST_F(ObjectTree, MovesFramesBelowAJointWithTheJoint) {
  world.joints().set_position(find("/motor"), M_PI / 2);  // the wheel's x axis is the world's -x axis then
  expect_near(world.pose(find("/rim")), Pose(0.9, 2.5, 0, 0, 0, M_PI), 1e-12);
  expect_near(world.pose(find("/hub")), Pose(1, 2.3, 0, 0, 0, M_PI), 1e-12);
  expect_near(world.pose(find("/post")), Pose(1, 2, 1, 0, 0, M_PI / 2), 1e-12);
}

TEST_F(ObjectTree, MovesWhatIsBelowAnObjectThatIsSetToAPose) {
  world.set_pose(base, Pose(0, 0, 5, 0, 0, 0));
  expect_near(world.pose(wheel), Pose(0.5, 0, 5, 0, 0, 0), 1e-12);
  expect_near(world.pose(find("/rim")), Pose(0.6, 0, 5, 0, 0, 0), 1e-12);
  expect_near(world.pose(find("/cargo")), Pose(0, 0, 8, 0, 0, -M_PI / 2), 1e-12);  // another model
  world.set_pose(find("/path"), Pose(0, 0, 0, 0, 0, M_PI / 2));
  expect_near(world.pose(find("/mark")), Pose(-1, 0, 0, 0, 0, M_PI / 2), 1e-12);
}

TEST_F(ObjectTree, MovesNoShapeOutOfItsLink) {
  EXPECT_THROW(world.set_pose(find("/rim"), Pose()), WrongObject);
  world.set_pose(find("/hub"), Pose(7, 8, 9, 0, 0, 0));
  expect_near(world.pose(find("/hub")), Pose(7, 8, 9, 0, 0, 0), 1e-12);
}

TEST_F(ObjectTree, CarriesAFrameWithItsNewParent) {
  const ObjectId path = find("/path");
  world.frames().set_parent(path, find("/motor"));
  EXPECT_EQ(world.tree().path(find("/mark")), "/base/motor/path/mark");
  expect_near(world.pose(find("/mark")), Pose(4, 1, 0, 0, 0, 0), 1e-12);  // nothing moves
  world.joints().set_position(find("/motor"), M_PI);                      // half a turn about (1, 2.5)
  expect_near(world.pose(find("/mark")), Pose(-2, 4, 0, 0, 0, M_PI), 1e-12);
  world.frames().set_parent(path, kNoObject);
  world.joints().set_position(find("/motor"), 0);
  expect_near(world.pose(find("/mark")), Pose(-2, 4, 0, 0, 0, M_PI), 1e-12);
}

TEST_F(ObjectTree, MovesAChainOfJointsOnce) {
  SceneDescription described = tree_scene();
  ModelDescription& robot = described.models[0];
  robot.links.push_back(link("hand", {1, 0, 0}));
  robot.links[2].place = place(31, 30);
  robot.joints.push_back(joint("revolute", {axis(Vector3::UnitZ(), MotorMode::kNone)}, {1, 0, 0}, "wheel", "hand"));
  robot.joints[1].place = place(30, 12);
  described.models[1].links[0].place->parent = 31;  // the hand holds the cargo
  World arm(described, 0);
  const auto pose = [&arm](const std::string& path) { return arm.pose(arm.tree().find(path)); };
  arm.joints().set_position(arm.tree().find("/motor"), M_PI / 2);  // about (1, 2.5)
  expect_near(pose("/base/motor/wheel/joint/hand"), Pose(0.5, 2.5, 0, 0, 0, M_PI), 1e-12);
  expect_near(pose("/hand/cargo"), Pose(1.5, 2.5, 3, 0, 0, M_PI / 2), 1e-12);
}

TEST_F(ObjectTree, HasNoCircles) {
  EXPECT_THROW(world.frames().set_parent(base, find("/rim")), InvalidInput);
  EXPECT_THROW(world.frames().set_parent(base, base), InvalidInput);
  EXPECT_EQ(world.tree().path(find("/rim")), "/base/motor/wheel/rim");
}

TEST_F(ObjectTree, KeepsWhatIsBelowARemovedModel) {
  const ObjectId dummy = world.frames().add_dummy("tip");
  world.set_pose(dummy, Pose(0, 0, 7, 0, 0, 0));
  world.frames().set_parent(dummy, find("/wheel"));
  world.models().remove(world.tree().models().front());
  EXPECT_EQ(children("/"), (Names{"path", "cargo", "tip"}));
  expect_near(world.pose(dummy), Pose(0, 0, 7, 0, 0, 0), 1e-12);
  expect_near(world.pose(find("/cargo")), Pose(1, 2, 3, 0, 0, 0), 1e-12);
}

TEST_F(ObjectTree, HasDummiesThatAreAddedAndRemoved) {
  const ObjectId upper = world.frames().add_dummy("upper");
  const ObjectId lower = world.frames().add_dummy("lower");
  world.frames().set_parent(lower, upper);
  world.frames().set_alias(lower, "tip");
  EXPECT_EQ(find("/upper/tip"), lower);
  world.set_pose(upper, Pose(0, 0, 1, 0, 0, 0));
  expect_near(world.pose(lower), Pose(0, 0, 1, 0, 0, 0), 1e-12);
  world.frames().remove_dummy(upper);
  EXPECT_EQ(find("/tip"), lower);
  expect_near(world.pose(lower), Pose(0, 0, 1, 0, 0, 0), 1e-12);
  EXPECT_THROW(world.pose(upper), NoSuchObject);
  EXPECT_THROW(world.frames().remove_dummy(find("/path")), WrongObject);  // of the scene
}

TEST_F(ObjectTree, PutsFramesBackWhenTheWorldIsReset) {
  const ObjectId dummy = world.frames().add_dummy("tip");
  world.set_pose(dummy, Pose(0, 0, 7, 0, 0, 0));
  const std::uint64_t start = world.state_hash();
  world.set_pose(find("/path"), Pose(0, 0, 0, 0, 0, 0));
  world.set_pose(find("/hub"), Pose(7, 8, 9, 0, 0, 0));
  EXPECT_NE(world.state_hash(), start);
  world.reset();
  EXPECT_EQ(world.state_hash(), start);
  expect_near(world.pose(find("/mark")), Pose(4, 1, 0, 0, 0, 0), 1e-12);
  expect_near(world.pose(find("/hub")), Pose(0.8, 2.5, 0, 0, 0, M_PI / 2), 1e-12);
  expect_near(world.pose(dummy), Pose(0, 0, 7, 0, 0, 0), 1e-12);
}

TEST_F(ObjectTree, PutsFramesBackAfterModelsWereAdded) {
  world.models().add(model("more", link("link", {9, 9, 9})));
  world.set_pose(find("/path"), Pose(0, 0, 0, 0, 0, 0));
  world.reset();
  expect_near(world.pose(find("/path")), Pose(4, 0, 0, 0, 0, 0), 1e-12);
  expect_near(world.pose(find("/rim")), Pose(1, 2.6, 0, 0, 0, M_PI / 2), 1e-12);
}

TEST_F(ObjectTree, IsNotChangedForTheOtherWorldsOfAScene) {
  const Scene shared(tree_scene());
  World one(shared, 0);
  const World other(shared, 0);
  one.frames().set_parent(one.tree().find("/path"), one.tree().find("/base"));
  one.frames().add_dummy("tip");
  EXPECT_EQ(other.tree().path(other.tree().find("/mark")), "/path/mark");
  EXPECT_THROW(other.tree().find("/tip"), NoSuchObject);
}

TEST(Places, ChangeNothingInThePhysics) {
  SceneDescription nested = tree_scene();
  SceneDescription placed = nested;
  for (SceneDescription* described : {&nested, &placed}) {
    described->gravity = {0, 0, -9.81};
    described->frames.clear();
    for (ModelDescription& model : described->models) model.frames.clear();
    described->models[0].links[0].sensors[0].place->parent = 10;  // its post is gone
    described->models[0].joints[0].axes[0].motor = MotorMode::kVelocity;
  }
  for (ModelDescription& model : nested.models) {
    model.is_object = true;
    for (LinkDescription& link : model.links) link.place.reset();
    for (JointDescription& joint : model.joints) joint.place.reset();
    for (SensorDescription& sensor : model.links[0].sensors) sensor.place.reset();
  }
  Simulation one(std::make_shared<const Scene>(nested));
  Simulation other(std::make_shared<const Scene>(placed));
  for (Simulation* simulation : {&one, &other}) {
    World& world = simulation->world();
    world.joints().set_target_velocity(world.tree().find("/motor"), 3);
    for (int i = 0; i < 20; ++i) simulation->step();
  }
  EXPECT_EQ(one.world().state_hash(), other.world().state_hash());
  EXPECT_EQ(one.shared_scene()->hash(), other.shared_scene()->hash());
}

/// The problem of a scene.
std::string problem(SceneDescription described) {
  try {
    const Scene scene(std::move(described));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "none";
}

TEST(Places, ThatContradictEachOtherAreRefused) {
  SceneDescription described = tree_scene();
  described.models[0].links[1].place->id = 10;
  EXPECT_NE(problem(described).find("/body/wheel: the place 10 in the tree is that of /body/base too"),
            std::string::npos)
      << problem(described);

  described = tree_scene();
  described.models[0].links[1].place->parent = 99;
  EXPECT_NE(problem(described).find("/body/wheel: its parent in the tree, 99, is the place of no object"),
            std::string::npos)
      << problem(described);

  described = tree_scene();
  described.models[0].links[0].place->parent = 13;
  EXPECT_NE(problem(described).find("/body/base: it is below itself in the tree"), std::string::npos)
      << problem(described);

  described = tree_scene();
  described.models[0].links[0].carrier = "none";
  EXPECT_NE(problem(described).find("/body/base: its carrier 'none' is no link"), std::string::npos)
      << problem(described);

  described = tree_scene();
  described.models[0].frames[0].link = "whell";
  EXPECT_NE(problem(described).find("whell"), std::string::npos) << problem(described);
}

}  // namespace
}  // namespace bubblesim::test::test_object_tree
