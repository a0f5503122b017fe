// SPDX-License-Identifier: BSD-3-Clause
// Poses and velocities of objects, and invalid arguments of setters.
#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/world.hpp"
#include "near.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_world_objects {
namespace {

constexpr double kStep = 0.005;

/// A rotated robot: `base` with an offset centre of mass and a sensor, `arm` on a hinge; and a static wall.
SceneDescription robot() {
  ModelDescription robot = model("Robot", link("base", {0.1, 0.2, 0.3}), Pose(1, 2, 3, 0.1, 0.2, 0.3));
  robot.links[0].pose.orientation = from_rpy(0.5, -0.4, 0.2);
  robot.links[0].centre_of_mass = {0.4, -0.3, 0.2};
  SensorDescription sonar;
  sonar.name = "Sonar";
  sonar.pose = Pose(0.5, 0, 0.1, 0, 0, 0.7);
  sonar.kind = SonarDescription{0, 2, 0.1};
  robot.links[0].sensors.push_back(sonar);
  robot.links.push_back(link("arm", {1, 0, 0}));
  robot.links[1].centre_of_mass = {0, 0.5, 0};
  robot.joints.push_back(joint("revolute", {axis(Vector3::UnitZ(), MotorMode::kVelocity)}, {0.5, 0, 0}));
  return scene({robot, still(model("Wall", link_with(Box{{1, 1, 1}}), Pose(5, 0, 0, 0, 0, 1)))}, Vector3::Zero());
}

class RobotWorld : public ::testing::Test {
 protected:
  ObjectId find(const std::string& path) const { return world.tree().find(path); }

  SceneDescription described = robot();
  World world{described, 0};
};

TEST_F(RobotWorld, PosesAreWhereTheSceneStates) {
  const ModelDescription& model = described.models[0];
  expect_near(world.pose(find("/Robot")), model.pose, 1e-12);
  expect_near(world.pose(find("/base")), model.pose * model.links[0].pose, 1e-12);
  expect_near(world.pose(find("/arm")), model.pose * model.links[1].pose, 1e-12);
  expect_near(world.pose(find("/joint")), model.pose * model.joints[0].pose, 1e-12);
  expect_near(world.joints().child_pose(find("/joint")), model.pose * model.joints[0].pose, 1e-12);
  expect_near(world.pose(find("/Sonar")), model.pose * model.links[0].pose * model.links[0].sensors[0].pose, 1e-12);
  expect_near(world.pose(find("/Wall/link")), described.models[1].pose, 1e-12);
}

TEST_F(RobotWorld, QuaternionsOfFewDigitsAreRotations) {
  constexpr double kRounded = 1.0005;
  SceneDescription rounded = described;
  for (ModelDescription& model : rounded.models) {
    model.pose.orientation.coeffs() *= kRounded;
    for (LinkDescription& link : model.links) link.pose.orientation.coeffs() *= kRounded;
    for (JointDescription& joint : model.joints) joint.pose.orientation.coeffs() *= kRounded;
  }
  rounded.models[0].links[0].sensors[0].pose.orientation.coeffs() *= kRounded;
  const World same{rounded, 0};
  for (const char* path : {"/Robot", "/base", "/arm", "/joint", "/Sonar", "/Wall/link"}) {
    expect_near(same.pose(same.tree().find(path)), world.pose(find(path)), 1e-12);
  }
}

TEST_F(RobotWorld, VelocityOfEachObjectIsThatOfItsOrigin) {
  const Vector3 linear(0.3, -0.2, 0.1);
  const Vector3 angular(0.2, 0.5, -0.7);
  world.set_velocity(find("/Robot"), {linear, angular});
  const Vector3 centre = world.pose(find("/Robot")).position;
  for (const char* path : {"/Robot", "/base", "/arm", "/joint", "/Sonar"}) {
    const Twist twist = world.velocity(find(path));
    EXPECT_LT((twist.angular - angular).norm(), 1e-12) << path;
    const Vector3 rigid = linear + angular.cross(world.pose(find(path)).position - centre);
    EXPECT_LT((twist.linear - rigid).norm(), 1e-12) << path;
  }
  EXPECT_EQ(world.velocity(find("/Wall")).linear.norm(), 0);
}

TEST_F(RobotWorld, StateIsPoseAndVelocityAtOnceOrNone) {
  world.set_state(find("/Robot"), at(7, 8, 9), {{1, 2, 3}, {}});
  EXPECT_LT((world.pose(find("/Robot")).position - Vector3(7, 8, 9)).norm(), 1e-12);
  EXPECT_LT((world.velocity(find("/arm")).linear - Vector3(1, 2, 3)).norm(), 1e-12);
  const std::uint64_t before = world.state_hash();
  EXPECT_THROW(world.set_state(find("/Robot"), at(1, 2, 3), {{kNaN, 0, 0}, {}}), InvalidInput);
  EXPECT_THROW(world.set_state(find("/Robot"), at(1, kNaN, 3), {{1, 0, 0}, {}}), InvalidInput);
  EXPECT_EQ(world.state_hash(), before);
}

TEST_F(RobotWorld, VelocityOfALinkIsSetForItAlone) {
  world.set_velocity(find("/arm"), {{1, 2, 3}, {4, 5, 6}});
  EXPECT_LT((world.velocity(find("/arm")).linear - Vector3(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((world.velocity(find("/arm")).angular - Vector3(4, 5, 6)).norm(), 1e-12);
  EXPECT_EQ(world.velocity(find("/base")).angular.norm(), 0);
}

TEST_F(RobotWorld, SpinningFreeBodyTurnsAboutItsCentreOfMass) {
  ModelDescription top = model("Top", link("link"));
  top.links[0].centre_of_mass = {1, 0, 0};
  World one(scene({top}, Vector3::Zero()), 0);
  const ObjectId id = one.tree().find("/Top");
  one.set_velocity(id, {{0, -0.5, 0}, {0, 0, 0.5}});  // the centre of mass is at rest
  one.advance(2, kStep);
  const Vector3 centre = one.pose(id) * Vector3(1, 0, 0);
  EXPECT_LT((centre - Vector3(1, 0, 0)).norm(), 1e-9);
  EXPECT_NEAR(to_rpy(one.pose(id).orientation).z(), 1, 1e-4);
}

TEST_F(RobotWorld, SettingAModelsPoseKeepsItsLinksTogether) {
  world.joints().set_target_velocity(find("/joint"), 0.5);
  world.advance(1, kStep);
  const Pose before = world.pose(find("/Robot"));
  const double angle = world.joints().position(find("/joint"));
  const Pose wanted(-3, 4, 0.5, 1, -0.5, 2);
  std::vector<std::pair<ObjectId, Pose>> relative;
  for (const char* path : {"/base", "/arm", "/joint", "/Sonar"}) {
    relative.emplace_back(find(path), before.inverse() * world.pose(find(path)));
  }
  world.set_pose(find("/Robot"), wanted);
  expect_near(world.pose(find("/Robot")), wanted, 1e-9);
  for (const auto& [id, pose] : relative) expect_near(wanted.inverse() * world.pose(id), pose, 1e-9);
  EXPECT_NEAR(world.joints().position(find("/joint")), angle, 1e-9);
}

TEST_F(RobotWorld, SettingALinksPoseMovesItAlone) {
  const Pose base = world.pose(find("/base"));
  const Pose wanted(7, 8, 9, 0.3, 0.2, 0.1);
  world.set_pose(find("/arm"), wanted);
  expect_near(world.pose(find("/arm")), wanted, 1e-9);
  expect_near(world.pose(find("/base")), base, 1e-12);
}

TEST_F(RobotWorld, SettingAPoseKeepsVelocities) {
  world.set_velocity(find("/arm"), {{1, 2, 3}, {}});
  world.set_pose(find("/arm"), at(9, 9, 9));
  EXPECT_LT((world.velocity(find("/arm")).linear - Vector3(1, 2, 3)).norm(), 1e-12);
}

TEST_F(RobotWorld, ModelFrameIsCarriedByTheCanonicalLink) {
  SceneDescription other = robot();
  other.models[0].canonical_link = "arm";
  World carried(other, 0);
  const Pose before = carried.pose(carried.tree().find("/Robot"));
  carried.set_pose(carried.tree().find("/base"), at(50, 0, 0));
  expect_near(carried.pose(carried.tree().find("/Robot")), before, 1e-12);
}

TEST_F(RobotWorld, ShapesAreReportedWhereTheyStand) {
  const std::vector<PlacedShape> shapes = world.geometry().shapes();
  ASSERT_EQ(shapes.size(), 1u);
  EXPECT_TRUE(shapes[0].is_static);
  EXPECT_EQ(shapes[0].link, find("/Wall/link"));
  expect_near(shapes[0].pose, described.models[1].pose, 1e-12);
}

/// Expects an InvalidInput whose text contains all of `parts`, and an unchanged world.
void expect_refused(World& world, const std::function<void()>& call, const std::vector<std::string>& parts) {
  const std::uint64_t before = world.state_hash();
  try {
    call();
    ADD_FAILURE() << "accepted: " << parts.back();
  } catch (const InvalidInput& error) {
    for (const std::string& part : parts) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what() << "\nlacks " << part;
    }
  }
  EXPECT_EQ(world.state_hash(), before);
}

struct BadNumber {
  double value;
  const char* shown;
};
const BadNumber kBadNumbers[] = {{kNaN, "nan"}, {kInfinity, "inf"}, {-kInfinity, "-inf"}, {1e300, "1e+300"}};

TEST_F(RobotWorld, BadPositionsAndVelocitiesAreRefusedByName) {
  for (const auto& [value, shown] : kBadNumbers) {
    for (int i = 0; i < 3; ++i) {
      Vector3 bad;
      bad[i] = value;
      for (const char* path : {"/Robot", "/Robot/arm"}) {
        const ObjectId id = find(path);
        const std::string name = world.tree().short_path(id);
        expect_refused(world, [&] { world.set_pose(id, Pose(bad, Quaternion())); }, {name, "position", shown});
        expect_refused(world, [&] { world.set_velocity(id, {bad, {}}); }, {name, "velocity", shown});
        expect_refused(world, [&] { world.set_velocity(id, {{}, bad}); }, {name, "velocity", shown});
      }
    }
  }
}

TEST_F(RobotWorld, OrientationsThatAreNoRotationsAreRefused) {
  for (const Quaternion& bad : {Quaternion(0, 0, 0, 0), Quaternion(kNaN, 0, 0, 0), Quaternion(1, 0, kInfinity, 0),
                                Quaternion(1e300, 0, 0, 0), Quaternion(2, 0, 0, 0), Quaternion(0, 0, 0, 0.5)}) {
    expect_refused(world, [&] { world.set_pose(find("/Robot"), Pose(Vector3::Zero(), bad)); },
                   {"/Robot", "orientation", "length 1"});
  }
}

TEST_F(RobotWorld, BadTargetsAreRefusedByName) {
  const ObjectId id = find("/joint");
  for (const auto& [value, shown] : kBadNumbers) {
    const double bad = value;
    expect_refused(world, [&] { world.joints().set_target_position(id, bad); }, {"/joint", "target position", shown});
    expect_refused(world, [&] { world.joints().set_target_velocity(id, bad); }, {"/joint", "target velocity", shown});
  }
  expect_refused(world, [&] { world.joints().set_max_force(id, kNaN); }, {"/joint", "force limit", "nan"});
  expect_refused(world, [&] { world.joints().set_max_force(id, -1); }, {"/joint", "force limit", "-1"});
  world.joints().set_max_force(id, kInfinity);
  world.joints().set_max_force(id, 1e300);
  world.joints().set_target_velocity(id, 1);
  world.advance(0.1, kStep);
  EXPECT_NEAR(world.joints().velocity(id), 1, 1e-6) << "a force without limit is fine";
}

TEST_F(RobotWorld, ObjectsOfTheWrongKindAreRefusedByName) {
  expect_refused(world, [&] { world.joints().position(find("/base")); }, {"/base", "link", "not a joint"});
  expect_refused(world, [&] { world.joints().child_pose(find("/Robot")); }, {"/Robot", "model", "not a joint"});
  expect_refused(world, [&] { world.joints().set_target_velocity(find("/Sonar"), 1); },
                 {"/Sonar", "sensor", "not a joint"});
  expect_refused(world, [&] { world.set_velocity(find("/Sonar"), {}); }, {"/Sonar", "cannot be moved on its own"});
  expect_refused(world, [&] { world.set_velocity(find("/Wall/link"), {}); }, {"/link", "static"});
  expect_refused(world, [&] { world.joints().position(find("/joint"), 1); }, {"/joint", "index 1"});
  expect_refused(world, [&] { world.joints().position(find("/joint"), -1); }, {"/joint", "index -1"});
}

TEST_F(RobotWorld, StaticModelsAndSensorsStayWhereTheyAreMoved) {
  const Pose elsewhere(7, 1, 0, 0, 0, 0.5);
  world.set_pose(find("/Wall"), elsewhere);
  world.set_pose(find("/Sonar"), elsewhere);
  world.advance(0.1, kStep);
  expect_near(world.pose(find("/Wall/link")), elsewhere, 1e-12);
  EXPECT_EQ(world.moved_statics(), std::set<ObjectId>{find("/Wall/link")});
  const auto hit = world.geometry().cast_ray({7, 1, 3}, {0, 0, -1}, 10);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 2.5, 1e-12);
  world.reset();
  expect_near(world.pose(find("/Wall/link")), described.models[1].pose, 1e-12);
  const ModelDescription& robot = described.models[0];
  expect_near(world.pose(find("/Sonar")), robot.pose * robot.links[0].pose * robot.links[0].sensors[0].pose, 1e-12);
}

/// An arm that is fixed to the world, with a load at its end.
SceneDescription fixed_arm(Solver solver) {
  ModelDescription arm = model("Arm", link("base", {0, 0, 1}));
  arm.links.push_back(link("tip", {0.5, 0, 1}));
  arm.joints = {joint("fixed", {}, {}, "world", "base"),
                joint("revolute", {axis(Vector3::UnitY(), MotorMode::kVelocity)}, {-0.5, 0, 0}, "base", "tip")};
  arm.joints[0].name = "anchor";
  SceneDescription made = scene({arm});
  made.solver = solver;
  return made;
}

TEST(FixedToTheWorld, AModelStaysWhereItIsPut) {
  for (const Solver solver : {Solver::kBubblesim, Solver::kOde}) {
    World moved(fixed_arm(solver), 0);
    moved.advance(0.1, kStep);
    const ObjectId base = moved.tree().find("/base");
    const Pose elsewhere(2, 1, 0.5, 0, 0, 1);
    moved.set_pose(moved.tree().find("/Arm"), elsewhere);
    const Pose put = moved.pose(base);
    expect_near(put, elsewhere * at(0, 0, 1), 1e-9);
    moved.advance(1, kStep);
    expect_near(moved.pose(base), put, 1e-4);
    World other(fixed_arm(solver), 0);
    restore(saved(moved), other);
    EXPECT_EQ(other.state_hash(), moved.state_hash());
    other.advance(1, kStep);
    expect_near(other.pose(base), put, 1e-4);
    moved.reset();
    moved.advance(1, kStep);
    expect_near(moved.pose(base), at(0, 0, 1), 1e-4);
  }
}

TEST_F(RobotWorld, HandlesThatNameNothingAreRefused) {
  for (const ObjectId id : {kNoObject, ObjectId{1000}}) {
    expect_refused(world, [&] { world.pose(id); }, {"no object", std::to_string(id)});
    expect_refused(world, [&] { world.velocity(id); }, {"no object", std::to_string(id)});
    expect_refused(world, [&] { world.set_pose(id, {}); }, {"no object", std::to_string(id)});
    expect_refused(world, [&] { world.set_velocity(id, {}); }, {"no object", std::to_string(id)});
    expect_refused(world, [&] { world.joints().position(id); }, {"no object", std::to_string(id)});
    expect_refused(world, [&] { world.joints().set_max_force(id, 1); }, {"no object", std::to_string(id)});
  }
}

TEST_F(RobotWorld, SetterOnALinkFarFromItsModelStaysFinite) {
  world.set_pose(find("/Robot"), at(999999, 0, 0));
  EXPECT_NO_THROW(world.pose(find("/arm")));
}

}  // namespace
}  // namespace bubblesim::test::test_world_objects
