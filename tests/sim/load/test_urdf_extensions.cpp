// SPDX-License-Identifier: BSD-3-Clause
// The <gazebo> elements of URDF.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "urdf_texts.hpp"

namespace bubblesim::test::test_urdf_extensions {
namespace {

const std::string kCollision = "<collision>" + kUnitBox + "</collision>";
const std::string kVisual = "<visual>" + kUnitBox + "</visual>";

/// Links `base` and `tool`, which is fixed 1 m above, turned by 90 degrees about z.
std::string arm(const std::string& more) {
  return robot(link_text("base", kUnitInertial + kCollision + kVisual) +
               link_text("tool", kUnitInertial + kCollision + kVisual) +
               joint_text("mount", "fixed", "base", "tool", "<origin xyz='0 0 1' rpy='0 0 1.5707963267948966'/>") +
               more);
}

std::string turning(const std::string& more) {
  return robot(link_text("base") + link_text("tool") + joint_text("j", "continuous", "base", "tool") + more);
}

LinkDescription base_of(const ModelDescription& model) { return model.links.at(0); }

Surface surface(const std::string& extensions, std::size_t collision = 0) {
  return base_of(read(arm(extensions))).collisions.at(collision).surface;
}

TEST(GazeboOfALink, SetsTheSurfaceOfItsCollisions) {
  const Surface read =
      surface(gazebo("base",
                     "<mu1>0.1</mu1><mu2>0.2</mu2><fdir1>0 1 0</fdir1><kp>1e5</kp><kd>3</kd><maxVel>0.4"
                     "</maxVel><minDepth>0.01</minDepth><maxContacts>5</maxContacts>"));
  EXPECT_EQ(read.mu, 0.1);
  EXPECT_EQ(read.mu2, 0.2);
  EXPECT_EQ(read.fdir1, Vector3(0, 1, 0));
  EXPECT_EQ(read.kp, 1e5);
  EXPECT_EQ(read.kd, 3);
  EXPECT_EQ(read.max_vel, 0.4);
  EXPECT_EQ(read.min_depth, 0.01);
  EXPECT_EQ(read.max_contacts, 5);
}

TEST(GazeboOfALink, IsForTheCollisionsOfThatLinkOnly) {
  const std::string extensions = gazebo("base", "<mu1>0.1</mu1>") + gazebo("tool", "<mu1>0.2</mu1>");
  EXPECT_EQ(surface(extensions, 0).mu, 0.1);
  EXPECT_EQ(surface(extensions, 1).mu, 0.2);
}

TEST(GazeboOfALink, IsNotForShapesWithAName) {
  const std::string text = robot(link_text("a", kUnitInertial + "<collision name='c'>" + kUnitBox + "</collision>") +
                                 "\n" + gazebo("a", "<mu1>0.1</mu1>"));
  EXPECT_EQ(base_of(read(text)).collisions.at(0).surface.mu, 1);
  EXPECT_TRUE(
      holds(warnings_about(text), "r.urdf:2: /r/a: values of <gazebo reference=\"a\"> for the collisions have no"));
}

TEST(GazeboOfALink, MayComeInSeveralParts) {
  const std::string extensions = gazebo("base", "<mu1>0.1</mu1><mu2>0.3</mu2>") + gazebo("base", "<mu1>0.2</mu1>");
  EXPECT_EQ(surface(extensions).mu, 0.2) << "the last one counts";
  EXPECT_EQ(surface(extensions).mu2, 0.3);
}

TEST(GazeboOfALink, MayHaveSdformatForItsCollisions) {
  const Surface read =
      surface(gazebo("base",
                     "<collision><surface><bounce><restitution_coefficient>0.5</restitution_coefficient>"
                     "</bounce><friction><ode><mu>2</mu><slip1>0.4</slip1></ode></friction></surface>"
                     "</collision><mu1>3</mu1>"));
  EXPECT_EQ(read.restitution, 0.5);
  EXPECT_EQ(read.slip1, 0.4);
  EXPECT_EQ(read.mu, 3);
}

TEST(GazeboOfALink, MayHaveItsValuesAsAttributes) { EXPECT_EQ(surface(gazebo("base", "<mu1 value='0.3'/>")).mu, 0.3); }

TEST(GazeboOfALink, TakesNegativeFrictionAsInfinite) {
  const std::string text = arm("\n" + gazebo("base", "<mu1>-1</mu1>"));
  EXPECT_EQ(warnings_about(text), "r.urdf:2: /r/base: <mu1> is below 0: using infinite friction\n");
  EXPECT_TRUE(std::isinf(base_of(read(text)).collisions.at(0).surface.mu));
}

TEST(GazeboOfALink, ReportsValuesThatCannotBeRead) {
  EXPECT_EQ(problems_of(arm(gazebo("base", "<mu1>x</mu1>\n<turnGravityOff>often</turnGravityOff>"))),
            "r.urdf:1: /r/base: <mu1> is 'x', it must be a number\n"
            "r.urdf:2: /r/base: <turnGravityOff> is 'often', it must be true or false\n");
}

TEST(GazeboOfALink, SetsGravityAndDamping) {
  const LinkDescription read = base_of(bubblesim::test::read(
      arm(gazebo("base", "<turnGravityOff>true</turnGravityOff><dampingFactor>0.1</dampingFactor>"))));
  EXPECT_FALSE(read.gravity_enabled);
  EXPECT_NEAR(read.linear_decay, -std::log(0.9) / 1e-3, 1e-9);
  EXPECT_NEAR(read.angular_decay, read.linear_decay, 1e-9);
}

TEST(GazeboOfALink, GivesAMaterialByItsName) {
  const LinkDescription read = base_of(bubblesim::test::read(arm(gazebo("tool", "<material>Gazebo/Blue</material>"))));
  EXPECT_TRUE(read.visuals.at(0).keeps_mesh_materials);
  EXPECT_EQ(read.visuals.at(1).material.diffuse.b, 1);
  EXPECT_EQ(read.visuals.at(1).material.diffuse.r, 0);
}

TEST(GazeboOfALink, MayHaveSdformatForItsVisuals) {
  const LinkDescription read = base_of(bubblesim::test::read(
      arm(gazebo("base",
                 "<visual><material><diffuse>0 1 0 1</diffuse></material><cast_shadows>false</cast_shadows>"
                 "</visual>"))));
  EXPECT_EQ(read.visuals.at(0).material.diffuse.g, 1);
  EXPECT_FALSE(read.visuals.at(0).cast_shadows);
}

TEST(GazeboOfALink, MayHaveSensors) {
  const LinkDescription read = base_of(bubblesim::test::read(arm(
      gazebo("base", "<sensor name='s' type='imu'><pose>1 2 3 0 0 0</pose><update_rate>7</update_rate></sensor>"))));
  EXPECT_EQ(read.sensors.at(0).name, "s");
  EXPECT_EQ(read.sensors[0].update_rate, 7);
  EXPECT_EQ(read.sensors[0].pose.position, Vector3(1, 2, 3));
}

TEST(GazeboOfALink, ThatIsLumpedMovesItsSensors) {
  const std::string sensor = "<sensor name='s' type='imu'><pose>1 0 0 0 0 0</pose></sensor>";
  const LinkDescription read =
      base_of(bubblesim::test::read(arm(gazebo("tool", sensor) + gazebo("base", "<sensor name='own' type='imu'/>"))));
  ASSERT_EQ(read.sensors.size(), 2U);
  EXPECT_EQ(read.sensors[0].name, "own") << "those of the link itself come first";
  EXPECT_TRUE(read.sensors[1].pose.position.isApprox(Vector3(0, 1, 1)));
  EXPECT_NEAR(read.sensors[1].pose.orientation.z(), std::sqrt(0.5), 1e-12);
}

TEST(GazeboOfALink, MayPlaceSensorsRelativeToOthers) {
  const std::string sensor = "<sensor name='s' type='imu'><pose relative_to='tool'>0 0 1 0 0 0</pose></sensor>";
  const LinkDescription read = base_of(bubblesim::test::read(arm(gazebo("base", sensor))));
  EXPECT_TRUE(read.sensors.at(0).pose.position.isApprox(Vector3(0, 0, 2)));
}

TEST(GazeboOfALink, RefersToCollisionsByTheirNamesInThatLink) {
  const std::string bumper =
      "<sensor name='s' type='contact'><contact><collision>tool_collision</collision></contact></sensor>";
  const LinkDescription read = base_of(bubblesim::test::read(arm(gazebo("tool", bumper))));
  EXPECT_EQ(read.sensors.at(0).kind.get<ContactDescription>().collisions,
            std::vector<std::string>{"base_fixed_joint_lump__tool_collision_1"});
}

TEST(GazeboOfALink, WarnsOfWhatItDoesNotKnow) {
  EXPECT_EQ(warnings_about(arm("\n" + gazebo("base", "<muu>1</muu>"))),
            "r.urdf:2: /r/base: <muu> is not an element of <link>: ignored\n");
  EXPECT_EQ(warnings_about(arm("\n" + gazebo("tol", "<mu1>1</mu1>"))),
            "r.urdf:2: /r: <gazebo> has reference='tol', which is not a link or joint: ignored; did you mean tool?\n");
}

TEST(GazeboOfAJoint, GivesItASpring) {
  const ModelDescription model =
      read(turning(gazebo("j",
                          "<springStiffness>3</springStiffness><springReference>0.2</springReference>"
                          "<implicitSpringDamper>1</implicitSpringDamper><provideFeedback>true</provideFeedback>")));
  EXPECT_EQ(model.joints.at(0).axes.at(0).spring_stiffness, 3);
  EXPECT_EQ(model.joints[0].axes[0].spring_reference, 0.2);
}

TEST(GazeboOfAJoint, MayHaveAForceTorqueSensor) {
  const std::string sensor = "<sensor name='ft' type='force_torque'/>";
  EXPECT_EQ(read(turning(gazebo("j", sensor))).joints.at(0).sensors.at(0).name, "ft");
  EXPECT_TRUE(holds(warnings_about(arm(gazebo("mount", sensor))), "/r/mount: <gazebo> is ignored: the joint is fixed"));
}

TEST(GazeboOfAJoint, MayChooseItsMotor) {
  const std::string motor = "<axis><bubblesim:motor>velocity</bubblesim:motor></axis>";
  EXPECT_EQ(read(turning(gazebo("j", motor))).joints.at(0).axes.at(0).motor, MotorMode::kVelocity);
}

TEST(GazeboOfTheRobot, HasPluginsAndFlags) {
  const ModelDescription model = read(turning(
      "<gazebo><static>true</static><self_collide>true</self_collide><plugin name='p' filename='l.so'><a>1</a></plugin>"
      "</gazebo>"));
  EXPECT_TRUE(model.is_static);
  EXPECT_TRUE(model.self_collide);
  EXPECT_EQ(model.plugins.at(0).filename, "l.so");
  EXPECT_EQ(model.plugins[0].parameters.at(0).text, "1");
}

TEST(GazeboOfTheRobot, NamesTheLinkThatALumpedLinkIsAPartOf) {
  const ModelDescription model =
      read(arm("<gazebo><plugin name='p' filename='l.so'><bodyName>tool</bodyName><xyzOffset>1 0 0</xyzOffset></plugin>"
               "</gazebo>"));
  const std::vector<PluginParameter>& parameters = model.plugins.at(0).parameters;
  ASSERT_EQ(parameters.size(), 4U);
  EXPECT_EQ(parameters[0].text, "base");
  EXPECT_EQ(parameters[1].name, "xyzOffset");
  double x = 1;
  double y = 0;
  double z = 0;
  ASSERT_EQ(std::sscanf(parameters[1].text.c_str(), "%lf %lf %lf", &x, &y, &z), 3);
  EXPECT_TRUE(Vector3(x, y, z).isApprox(Vector3(0, 1, 1)));
}

TEST(GazeboOfTheRobot, ClosesLoops) {
  const ModelDescription model = read(robot(
      link_text("a") + link_text("b") + link_text("c") + link_text("d") + joint_text("j", "continuous", "a", "b") +
      joint_text("k", "continuous", "a", "c") + joint_text("l", "fixed", "c", "d") +
      "<gazebo><joint name='loop' type='ball'><parent>d</parent><child>b</child></joint></gazebo>"));
  const JointDescription& loop = model.joints.at(2);
  EXPECT_EQ(loop.name, "loop");
  EXPECT_EQ(loop.parent, "c");
  EXPECT_EQ(loop.child, "b");
  EXPECT_EQ(loop.pose.position, Vector3(0, 0, 1));
}

}  // namespace
}  // namespace bubblesim::test::test_urdf_extensions
