// SPDX-License-Identifier: BSD-3-Clause
// Links, joints, shapes and materials of URDF, and what is wrong with a file.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bubblesim/urdf.hpp"
#include "load/urdf/urdf_robot.hpp"
#include "urdf_texts.hpp"

namespace bubblesim::test::test_urdf {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const JointDescription& only_joint(const ModelDescription& model) { return model.joints.at(0); }

ModelDescription two_links(const std::string& type, const std::string& parts) {
  return read(robot(link_text("a") + link_text("b") + joint_text("j", type, "a", "b", parts)));
}

std::string problems_of_joint(const std::string& type, const std::string& parts) {
  return problems_of(robot(link_text("a") + link_text("b") + joint_text("j", type, "a", "b", parts)));
}

VisualDescription with_material(const std::string& material, const std::string& before = "") {
  return read(robot(before + link_text("a", kUnitInertial + "<visual>" + kUnitBox + material + "</visual>")))
      .links.at(0)
      .visuals.at(0);
}

Geometry shape(const std::string& geometry) {
  return read(robot(link_text("a", kUnitInertial + "<collision><geometry>" + geometry + "</geometry></collision>")))
      .links.at(0)
      .collisions.at(0)
      .geometry;
}

std::string problems_of_shape(const std::string& geometry) {
  return problems_of(
      robot(link_text("a", kUnitInertial + "<collision>\n<geometry>" + geometry + "</geometry></collision>")));
}

TEST(UrdfLink, IsPlacedByTheJointsAboveIt) {
  const std::string turned = "<origin xyz='1 0 0' rpy='0 0 1.5707963267948966'/>" + kTurning;
  const ModelDescription model =
      read(robot(link_text("a") + link_text("b") + link_text("c") + joint_text("j", "revolute", "a", "b", turned) +
                 joint_text("k", "revolute", "b", "c", turned)));
  EXPECT_TRUE(model.links.at(2).pose.position.isApprox(Vector3(1, 1, 0)));
  EXPECT_NEAR(std::abs(model.links[2].pose.orientation.z()), 1, 1e-12);
  EXPECT_TRUE(model.joints.at(1).pose.position.isApprox(Vector3(1, 1, 0)));
}

TEST(UrdfLink, ComesAfterItsParentInTheOrderOfTheNamesOfJoints) {
  const ModelDescription model =
      read(robot(link_text("z") + link_text("x") + link_text("base") + link_text("y") +
                 joint_text("2", "continuous", "base", "z") + joint_text("1", "continuous", "base", "y") +
                 joint_text("0", "continuous", "z", "x")));
  EXPECT_EQ(names_of_links(model), (std::vector<std::string>{"base", "y", "z", "x"}));
}

TEST(UrdfInertia, IsTurnedToTheAxesOfTheLink) {
  const ModelDescription model =
      read(robot(link_text("a",
                           "<inertial><origin xyz='1 2 3' rpy='0 0 1.5707963267948966'/><mass value='4'/>"
                           "<inertia ixx='1' ixy='0' ixz='0.1' iyy='2' iyz='0' izz='2.5'/></inertial>")));
  const LinkDescription& body = model.links.at(0);
  EXPECT_EQ(body.mass, 4);
  EXPECT_EQ(body.centre_of_mass, Vector3(1, 2, 3));
  EXPECT_TRUE(body.inertia_diagonal.isApprox(Vector3(2, 1, 2.5)));
  EXPECT_TRUE(body.inertia_products.isApprox(Vector3(0, 0, 0.1), 1e-9));
}

TEST(UrdfInertia, WithoutProductsHasNone) {
  const std::string text =
      robot(link_text("a", "<inertial><mass value='1'/>\n<inertia ixx='1' iyy='2' izz='2.5'/></inertial>"));
  EXPECT_EQ(read(text).links.at(0).inertia_diagonal, Vector3(1, 2, 2.5));
  EXPECT_EQ(warnings_about(text), "r.urdf:2: /r/a: <inertia> has no ixy, ixz, iyz: taken as 0\n");
}

TEST(UrdfJoint, HasItsAxisLimitsAndDynamics) {
  const JointDescription revolute =
      only_joint(two_links("revolute",
                           "<axis xyz='0 3 4'/><limit lower='-1' upper='2' effort='5' velocity='6'/>"
                           "<dynamics damping='0.1' friction='0.2'/><safety_controller k_velocity='1'/>"));
  EXPECT_EQ(revolute.type, "revolute");
  EXPECT_EQ(revolute.parent, "a");
  EXPECT_EQ(revolute.child, "b");
  const AxisDescription& axis = revolute.axes.at(0);
  EXPECT_TRUE(axis.direction.isApprox(Vector3(0, 0.6, 0.8)));
  EXPECT_EQ(axis.lower, -1);
  EXPECT_EQ(axis.upper, 2);
  EXPECT_EQ(axis.max_force, 5);
  EXPECT_EQ(axis.max_velocity, 6);
  EXPECT_EQ(axis.damping, 0.1);
  EXPECT_EQ(axis.friction, 0.2);
}

TEST(UrdfJoint, TurnsAboutXByDefault) {
  EXPECT_EQ(only_joint(two_links("continuous", "")).axes.at(0).direction, Vector3(1, 0, 0));
}

TEST(UrdfJoint, ThatIsContinuousHasNoPositionLimits) {
  const JointDescription joint =
      only_joint(two_links("continuous", "<limit lower='-1' upper='1' effort='2' velocity='3'/>"));
  EXPECT_EQ(joint.type, "revolute");
  EXPECT_EQ(joint.axes.at(0).lower, -kInfinity);
  EXPECT_EQ(joint.axes.at(0).upper, kInfinity);
  EXPECT_EQ(joint.axes.at(0).max_force, 2);
}

TEST(UrdfJoint, WithLimitsInTheWrongOrderExchangesThem) {
  const std::string limit = "\n<limit lower='2' upper='-1' effort='1' velocity='1'/>";
  const AxisDescription axis = only_joint(two_links("prismatic", limit)).axes.at(0);
  EXPECT_EQ(axis.lower, -1);
  EXPECT_EQ(axis.upper, 2);
  EXPECT_EQ(warnings_about(robot(link_text("a") + link_text("b") + joint_text("j", "prismatic", "a", "b", limit))),
            "r.urdf:2: /r/j: the lower limit 2 is above the upper limit -1: they are exchanged\n");
}

TEST(UrdfJoint, WithoutPositionLimitsIsHeldAtZero) {
  const AxisDescription axis = only_joint(two_links("revolute", "<limit effort='1' velocity='1'/>")).axes.at(0);
  EXPECT_EQ(axis.lower, 0);
  EXPECT_EQ(axis.upper, 0);
}

TEST(UrdfJoint, NamedAsALinkGetsAnotherName) {
  const std::string text =
      robot(link_text("a") + link_text("b") + link_text("c") + joint_text("b", "continuous", "a", "b") +
            joint_text("k", "continuous", "a", "c", "<mimic joint='b'/>"));
  const ModelDescription model = read(text);
  EXPECT_EQ(only_joint(model).name, "b_joint");
  EXPECT_EQ(model.joints.at(1).axes.at(0).mimic->joint, "b_joint");
  EXPECT_TRUE(holds(warnings_about(text), "/r/b_joint: renamed: a link has the name 'b'"));
}

TEST(UrdfJoint, ToTheWorldHoldsItsChild) {
  const ModelDescription model =
      read(robot(link_text("world", "") + link_text("a") + joint_text("j", "fixed", "world", "a")));
  EXPECT_EQ(names_of_links(model), std::vector<std::string>{"a"});
  EXPECT_EQ(only_joint(model).type, "fixed");
  EXPECT_EQ(only_joint(model).parent, "world");
  EXPECT_EQ(model.links.at(0).pose.position, Vector3(0, 0, 1));
}

TEST(UrdfMimic, HasItsLeaderAndItsLine) {
  const std::string text =
      robot(link_text("a") + link_text("b") + link_text("c") + joint_text("j", "continuous", "a", "b") +
            joint_text("k", "continuous", "a", "c", "<mimic joint='j' multiplier='-2' offset='0.5'/>"));
  const AxisDescription axis = read(text).joints.at(1).axes.at(0);
  ASSERT_TRUE(axis.mimic);
  EXPECT_EQ(axis.mimic->joint, "j");
  EXPECT_EQ(axis.mimic->multiplier, -2);
  EXPECT_EQ(axis.mimic->offset, 0.5);
}

TEST(UrdfTransmission, IsKept) {
  LoadContext context("r.urdf", ".");
  const XmlElement root =
      parse_xml(robot(link_text("a") + "<transmission name='t'><type>Simple</type><joint name='j'>"
                                       "<hardwareInterface>Effort</hardwareInterface></joint>"
                                       "<actuator name='m'><mechanicalReduction>50</mechanicalReduction>"
                                       "</actuator></transmission>"),
                "r.urdf", context.warnings());
  const TransmissionDescription read = read_robot(root, context).transmissions.at(0);
  EXPECT_EQ(read.name, "t");
  EXPECT_EQ(read.type, "Simple");
  EXPECT_EQ(read.joints.at(0).name, "j");
  EXPECT_EQ(read.joints[0].hardware_interfaces, std::vector<std::string>{"Effort"});
  EXPECT_EQ(read.actuators.at(0).name, "m");
  EXPECT_EQ(read.actuators[0].mechanical_reduction, 50);
}

TEST(UrdfShape, IsABoxASphereACylinderOrACapsule) {
  EXPECT_EQ(std::get<Box>(shape("<box size='1 2 3'/>")).size, Vector3(1, 2, 3));
  EXPECT_EQ(std::get<Sphere>(shape("<sphere radius='0.5'/>")).radius, 0.5);
  EXPECT_EQ(std::get<Cylinder>(shape("<cylinder radius='0.5' length='2'/>")).length, 2);
  EXPECT_EQ(std::get<Capsule>(shape("<capsule radius='0.5' length='2'/>")).radius, 0.5);
}

TEST(UrdfShape, IsPlacedByItsOrigin) {
  const ModelDescription model = read(robot(
      link_text("a", kUnitInertial + "<collision><origin xyz='1 2 3' rpy='0 0 3'/>" + kUnitBox + "</collision>")));
  const Pose& pose = model.links.at(0).collisions.at(0).pose;
  EXPECT_EQ(pose.position, Vector3(1, 2, 3));
  EXPECT_NEAR(pose.orientation.z(), std::sin(1.5), 1e-12);
}

TEST(UrdfShape, OfAnUnknownGeometryIsLeftOut) {
  const std::string text =
      robot(link_text("a", kUnitInertial + "<collision><geometry>\n<cone/></geometry></collision>"));
  EXPECT_TRUE(read(text).links.at(0).collisions.empty());
  EXPECT_TRUE(holds(warnings_about(text), "r.urdf:2: /r/a: <cone> is not a geometry of URDF"));
}

TEST(UrdfShape, WithoutAMeshFileStatesWhereItIsSearched) {
  const std::string text = robot(link_text(
      "a", kUnitInertial + "<collision><geometry><mesh filename='package://nowhere/a.stl'/></geometry></collision>"));
  EXPECT_TRUE(holds(warnings_about(text), "/r/a/a_collision: file not found: 'package://nowhere/a.stl'"));
}

TEST(UrdfMaterial, HasItsColour) {
  // Gazebo divides colours by 0.8.
  const Color color = with_material("<material name='m'><color rgba='0.4 0.2 1 1'/></material>").material.diffuse;
  EXPECT_FLOAT_EQ(color.r, 0.5F);
  EXPECT_FLOAT_EQ(color.g, 0.25F);
  EXPECT_FLOAT_EQ(color.b, 1.0F);
}

TEST(UrdfMaterial, OfTheRobotIsUsedByItsName) {
  const std::string defined = "<material name='m'><color rgba='0 0.4 0 1'/></material>";
  EXPECT_FLOAT_EQ(with_material("<material name='m'/>", defined).material.diffuse.g, 0.5F);
  const std::string other = "<material name='m'><color rgba='1 0 0 1'/></material>";
  EXPECT_FLOAT_EQ(with_material(other, defined).material.diffuse.g, 0.5F) << "the first definition counts";
}

TEST(UrdfMaterial, ThatIsUnknownIsNone) {
  const std::string text =
      robot(link_text("a", kUnitInertial + "<visual>" + kUnitBox + "\n<material name='m'/></visual>"));
  EXPECT_TRUE(read(text).links.at(0).visuals.at(0).keeps_mesh_materials);
  EXPECT_EQ(warnings_about(text), "r.urdf:2: /r/a: the material 'm' is not defined before: it has no colour\n");
}

TEST(UrdfMaterial, OutOfRangeIsBroughtBack) {
  const Color color = with_material("<material name='m'><color rgba='255 -1 0 1'/></material>").material.diffuse;
  EXPECT_EQ(color.r, 1);
  EXPECT_EQ(color.g, 0);
}

TEST(UrdfNumbers, ThatCannotBeReadAreErrors) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {problems_of(robot(link_text("a", "<inertial><mass value='2,5'/>" + kUnitInertia + "</inertial>"))),
       "r.urdf:1: /r/a: <mass> has value='2,5', it must be a finite number\n"},
      {problems_of(robot(link_text("a", "<inertial><mass value='1'/>\n<inertia ixx='nan'/></inertial>"))),
       "r.urdf:2: /r/a: <inertia> has ixx='nan', it must be a finite number\n"},
      {problems_of_shape("\n<box size='1 2'/>"),
       "r.urdf:3: /r/a: <box> has size='1 2', it must be three finite numbers\n"},
      {problems_of_shape("<sphere/>"), "r.urdf:2: /r/a: <sphere> has no attribute radius: URDF requires it\n"},
      {problems_of_shape("<mesh/>"), "r.urdf:2: /r/a: <mesh> has no filename: it must name a mesh file\n"},
      {problems_of_joint("revolute", "<limit effort='x' velocity='1'/>"),
       "r.urdf:1: /r/j: <limit> has effort='x', it must be a finite number\n"},
      {problems_of_joint("revolute", "<limit effort='1'/>"),
       "r.urdf:1: /r/j: <limit> has no attribute velocity: URDF requires it\n"},
      {problems_of_joint("continuous", "<axis xyz='0 0 0'/>"),
       "r.urdf:1: /r/j: <axis> has xyz='0 0 0': it needs a direction\n"},
      {problems_of_joint("fixed", "<origin xyz='0 1 x'/>"),
       "r.urdf:1: /r/j: <origin> has xyz='0 1 x', it must be three finite numbers\n"},
      {problems_of_joint("continuous", "<dynamics damping='inf'/>"),
       "r.urdf:1: /r/j: <dynamics> has damping='inf', it must be a finite number\n"},
      {problems_of_joint("continuous", "<mimic multiplier='1'/>"),
       "r.urdf:1: /r/j: <mimic> has no attribute joint: it must name the joint to follow\n"},
  };
  for (const auto& [reported, expected] : cases) EXPECT_EQ(reported, expected);
}

TEST(UrdfNumbers, AreAllReportedAtOnce) {
  const std::string reported =
      problems_of(robot(link_text("a", "<inertial><mass value='x'/></inertial>") + link_text("b") +
                        joint_text("j", "revolute", "a", "b", "<origin xyz='y'/>")));
  EXPECT_TRUE(holds(reported, "value='x'")) << reported;
  EXPECT_TRUE(holds(reported, "xyz='y'")) << reported;
  EXPECT_TRUE(holds(reported, "has no <limit>")) << reported;
}

TEST(UrdfTree, ThatIsNoneStatesWhy) {
  const std::string loop = joint_text("j", "fixed", "b", "c") + joint_text("k", "fixed", "c", "b");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {link_text("a") + link_text("b"),
       "/r/b: is not attached to the other links: the links that are no child of a joint are 'a', "
       "'b', there must be one"},
      {link_text("a") + link_text("b") + link_text("c") + loop, "/r/b: is in a loop of joints, or below one"},
      {link_text("a") + link_text("b") + link_text("c") + joint_text("j", "fixed", "a", "c") +
           joint_text("k", "fixed", "b", "c"),
       "/r/k: 'c' is the child of 'j', too, in line 1"},
      {link_text("a") + joint_text("j", "fixed", "a", "a"), "/r/j: joins 'a' to itself"},
      {link_text("arm") + joint_text("j", "fixed", "arm", "amr"),
       "the child link [amr] of joint [j] is not in the file: add this <link> or correct the name; did you mean arm?"},
      {link_text("a") + joint_text("j", "fixed", "b", "a"), "the parent link [b] of joint [j] is not in the file"},
      {link_text("a") + "<joint name='j' type='fixed'><child link='a'/></joint>", "/r/j: has no <parent link=\"...\">"},
      {link_text("a") + "\n" + link_text("a"), "r.urdf:2: /r/a: another link, in line 1, has the name 'a'"},
      {link_text("a") + link_text("b") + link_text("c") + joint_text("j", "fixed", "a", "b") +
           joint_text("j", "fixed", "a", "c"),
       "/r/j: another joint, in line 1, has the name 'j'"},
      {link_text(""), "/r: <link> has no name"},
      {link_text("a") + link_text("b") + joint_text("j", "hinge", "a", "b"),
       "/r/j: unknown joint type 'hinge', it must be revolute"},
      {link_text("a") + link_text("b") + joint_text("j", "Fixed", "a", "b"), "did you mean fixed?"},
      {"", "/r: contains no <link> except the world"},
  };
  for (const auto& [parts, expected] : cases) {
    const std::string reported = problems_of(robot(parts));
    EXPECT_TRUE(holds(reported, expected)) << reported;
  }
}

TEST(UrdfVersion, IsChecked) {
  const auto of_version = [](const std::string& version) {
    return problems_of("<robot name='r' version='" + version + "'>" + link_text("a") + "</robot>");
  };
  EXPECT_EQ(of_version("1.0"), "it loads");
  EXPECT_EQ(of_version("1.1"), "it loads");
  EXPECT_EQ(of_version("2"), "r.urdf:1: /r: <robot> has version='2', it must be 1.0, 1.1 or 1.2\n");
}

TEST(UrdfOrigin, MayBeAQuaternion) {
  const ModelDescription model = two_links("continuous", "<origin xyz='1 0 0' quat_xyzw='0 0 2 0'/>");
  EXPECT_NEAR(std::abs(model.links.at(1).pose.orientation.z()), 1, 1e-12);
}

TEST(UrdfChain, OfManyLinksIsRead) {
  std::string moving = link_text("0");
  for (int i = 1; i < 5000; ++i) {
    const std::string name = std::to_string(i);
    moving += link_text(name) + joint_text("j" + name, "continuous", std::to_string(i - 1), name);
  }
  EXPECT_NEAR(read(robot(moving)).links.at(4999).pose.position.z(), 4999, 1e-6);
}

TEST(UrdfWriter, WritesWhatIsReadAgain) {
  const std::string text = robot(
      link_text("a") +
      link_text("b", kUnitInertial + "<visual><origin xyz='1 2 3' rpy='0.1 0.2 0.3'/>" + kUnitBox +
                         "</visual><collision><geometry><cylinder radius='0.5' length='2'/></geometry></collision>") +
      joint_text("j", "prismatic", "a", "b",
                 "<origin xyz='0 1 0' rpy='0.3 0.2 0.1'/><axis xyz='0 0 1'/><limit lower='-1' upper='2' effort='3' "
                 "velocity='4'/>"));
  const ModelDescription model = read(text);
  const ModelDescription again = read(to_urdf(model));
  EXPECT_EQ(names_of_links(again), names_of_links(model));
  EXPECT_TRUE(again.links[1].pose.position.isApprox(model.links[1].pose.position));
  EXPECT_TRUE(again.links[1].pose.orientation.isApprox(model.links[1].pose.orientation, 1e-9));
  EXPECT_TRUE(
      again.links[1].visuals.at(0).pose.orientation.isApprox(model.links[1].visuals.at(0).pose.orientation, 1e-9));
  EXPECT_EQ(std::get<Cylinder>(again.links[1].collisions.at(0).geometry).radius, 0.5);
  EXPECT_EQ(again.joints.back().type, "prismatic");
  EXPECT_EQ(again.joints.back().axes.at(0).upper, 2);
}

}  // namespace
}  // namespace bubblesim::test::test_urdf
