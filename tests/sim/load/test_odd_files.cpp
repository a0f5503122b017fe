// SPDX-License-Identifier: BSD-3-Clause
// Unusual files that are valid, or that Gazebo accepts.
#include <gtest/gtest.h>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/world.hpp"
#include "near.hpp"
#include "scene_files.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_odd_files {
namespace {

const std::string kInertial =
    "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";

SceneDescription loaded(const std::string& text, const std::string& name = "odd.sdf",
                        std::vector<Problem>* warnings = nullptr) {
  const TemporaryFile file(name, text);
  SceneDescription scene = read_scene(file.path(), {}, warnings);
  World world(scene, 0);
  world.advance(0.1, 0.005);
  return scene;
}

std::string reported_for(const std::string& text, const std::string& name = "odd.sdf") {
  try {
    loaded(text, name);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "it loads";
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string robot(const std::string& parts) { return "<robot name='r'>" + parts + "</robot>"; }
std::string heavy(const std::string& name) { return "<link name='" + name + "'>" + kInertial + "</link>"; }
std::string urdf_joint(const std::string& type, const std::string& parent, const std::string& child,
                       const std::string& more = "<axis xyz='0 0 1'/><limit effort='0' velocity='0'/>") {
  return "<joint name='" + parent + "_" + child + "' type='" + type + "'><parent link='" + parent + "'/><child link='" +
         child + "'/><origin xyz='0 0 2'/>" + more + "</joint>";
}

const ModelDescription& the_robot(const SceneDescription& scene) { return scene.models.back(); }

TEST(PhysicsStep, ThatDoesNotFitADefaultPassMakesItShorter) {
  const auto pass = [](const std::string& step) {
    return loaded(in_world("<physics type='ode'><max_step_size>" + step + "</max_step_size></physics>")).time_step;
  };
  EXPECT_NEAR(pass("0.004"), 0.048, 1e-12);
  EXPECT_NEAR(pass("0.0083333"), 6 * 0.0083333, 1e-12);
  EXPECT_NEAR(pass("0.2"), 0.2, 1e-12);
  EXPECT_NEAR(pass("0.001"), 0.05, 1e-12);
}

TEST(Version, IsAskedFor) {
  EXPECT_TRUE(holds(reported_for("<sdf><world name='w'/></sdf>"), ":1: <sdf> has no version"));
  EXPECT_TRUE(holds(reported_for("<sdf version='abc'><world name='w'/></sdf>"), ":1: invalid version 'abc': expected"));
}

TEST(Latin1, IsRead) {
  const SceneDescription scene = loaded("<sdf version='1.6'><model name='m\xfcll'><link name='l'/></model></sdf>");
  EXPECT_EQ(the_robot(scene).name, "m\xc3\xbcll");
}

TEST(Light, OnItsOwnShinesOnAGroundPlane) {
  const SceneDescription scene =
      loaded("<sdf version='1.6'><light name='l' type='point'><pose>0 0 3 0 0 0</pose></light></sdf>");
  ASSERT_EQ(scene.environment.lights.size(), 1U);
  EXPECT_EQ(scene.environment.lights[0].position, Vector3(0, 0, 3));
}

TEST(Light, OfALinkIsInItsFrame) {
  const SceneDescription scene = loaded(
      in_world("<model name='m'><pose>5 0 0 0 0 0</pose><link name='l'><light name='lamp' type='spot'><pose>0 0 1 0 0 0"
               "</pose><direction>1 0 0</direction></light></link></model>"));
  const LinkDescription& link = the_robot(scene).links[0];
  ASSERT_EQ(link.lights.size(), 1U);
  EXPECT_EQ(link.lights[0].position, Vector3(0, 0, 1));
  EXPECT_EQ(link.lights[0].direction, Vector3(1, 0, 0));
}

TEST(Inertia, ThatIsTinyStays) {
  const SceneDescription scene = loaded(
      in_world("<model name='m'><link name='l'><inertial><mass>1e-5</mass><inertia><ixx>1e-9</ixx><iyy>1e-9</iyy>"
               "<izz>1e-9</izz></inertia></inertial></link></model>"));
  EXPECT_EQ(the_robot(scene).links[0].inertia_diagonal.x(), 1e-9);
}

TEST(MagneticField, IsThatOfTheWorld) {
  EXPECT_EQ(loaded(in_world("")).environment.magnetic_field.x(), 5.5645e-6);
  const SceneDescription scene = loaded(in_world("<magnetic_field>1.2345e-5 2e-5 -3e-5</magnetic_field>"));
  EXPECT_EQ(scene.environment.magnetic_field.x(), 1.2345e-5);
}

TEST(Sensor, OfALaterVersionIsLeftOut) {
  const SceneDescription scene =
      loaded(in_world("<model name='m'><link name='l'><sensor name='s' type='air_speed'/></link></model>"));
  EXPECT_TRUE(the_robot(scene).links[0].sensors.empty());
}

TEST(StaticModel, WithoutLinksIsLeftOut) {
  EXPECT_TRUE(loaded(in_world("<model name='m'><static>true</static></model>")).models.empty());
}

TEST(Inertia, OfZeroIsReplaced) {
  const SceneDescription scene = loaded(
      in_world("<model name='m'><link name='l'><inertial><mass>2</mass><inertia><ixx>0</ixx><iyy>0</iyy><izz>0</izz>"
               "</inertia></inertial></link></model>"));
  expect_near(the_robot(scene).links[0].inertia_diagonal, Vector3::Constant(0.008), 1e-12);
}

TEST(Inertia, ThatIsPositiveByRoundingOnlyIsReplaced) {
  const SceneDescription scene = loaded(
      in_world("<model name='m'><link name='l'><inertial><mass>1</mass><inertia><ixx>0.2125</ixx><iyy>0.205</iyy>"
               "<izz>0.0125</izz><ixy>-0.005</ixy><ixz>0.0225</ixz><iyz>0.045</iyz></inertia></inertial></link>"
               "</model>"));
  // The least moment, 0, becomes a thousandth of the greatest, and their sum grows by as much.
  EXPECT_NEAR(the_robot(scene).links[0].inertia_diagonal.sum(), 0.43 + 0.000220, 1e-5);
}

TEST(Shapes, OfOneNameAreAllKept) {
  const auto part = [&](const std::string& kind, const std::string& height) {
    return "<" + kind + " name='s'><pose>0 0 " + height +
           " 0 0 0</pose><geometry><sphere><radius>1</radius></sphere></geometry></" + kind + ">";
  };
  const SceneDescription scene =
      loaded(in_world("<model name='m'><link name='l'>" + part("collision", "1") + part("collision", "2") +
                      part("visual", "3") + part("visual", "4") + "</link></model>"));
  const LinkDescription& link = the_robot(scene).links[0];
  ASSERT_EQ(link.collisions.size(), 2U);
  EXPECT_EQ(link.collisions[1].name, "s_2");
  EXPECT_EQ(link.collisions[1].pose.position, Vector3(0, 0, 2));
  ASSERT_EQ(link.visuals.size(), 2U);
  EXPECT_EQ(link.visuals[1].pose.position, Vector3(0, 0, 4));
}

TEST(Visual, MayBeFlat) {
  const SceneDescription scene = loaded(
      in_world("<model name='m'><link name='l'><visual name='v'><geometry><box><size>1 1 0</size></box></geometry>"
               "</visual></link></model>"));
  EXPECT_EQ(std::get<Box>(the_robot(scene).links[0].visuals[0].geometry).size, Vector3(1, 1, 0.001));
}

TEST(Model, NamedWithASlashGetsANameForPaths) {
  EXPECT_EQ(the_robot(loaded(in_world("<model name='a/b'><link name='l'/></model>"))).name, "a_b");
}

TEST(Elements, ThatSdformatDoesNotKnowAreReported) {
  std::vector<Problem> warnings;
  loaded("<sdf version='1.9'><model name='m'>\n<link name='l'>\n<contact/></link></model></sdf>", "odd.sdf", &warnings);
  const std::string reported = lines_of(warnings);
  EXPECT_TRUE(holds(reported, "odd.sdf:3: /m/l: <contact> is not an element of <link>: ignored\n")) << reported;
}

TEST(SeveralModels, InAFileWithoutAWorldAreOne) {
  const SceneDescription scene = loaded(
      "<sdf version='1.4'><model name='m'><link name='l'/></model><model name='n'><link name='l'/></model></sdf>");
  EXPECT_EQ(the_robot(scene).name, "m");
}

TEST(Urdf, LetsGoWhatFloats) {
  for (const std::string type : {"floating", "planar"}) {
    const SceneDescription scene = loaded(robot(heavy("a") + heavy("b") + urdf_joint(type, "a", "b")), "odd.urdf");
    ASSERT_EQ(the_robot(scene).links.size(), 2U) << type;
    EXPECT_EQ(the_robot(scene).links[1].pose.position, Vector3(0, 0, 2));
    EXPECT_TRUE(the_robot(scene).joints.empty()) << type;
  }
}

TEST(Urdf, LumpsLinksWithoutMassWhateverItIsAsked) {
  for (const std::string keep : {"preserveFixedJoint", "disableFixedJointLumping"}) {
    const std::string extensions = "<gazebo reference='foot_a'><" + keep + ">true</" + keep +
                                   "></gazebo><gazebo reference='laser'><sensor type='imu' name='i'/></gazebo>" +
                                   "<gazebo reference='a_laser'><" + keep + ">true</" + keep + "></gazebo>";
    const SceneDescription scene =
        loaded(robot("<link name='foot'/>" + heavy("a") + urdf_joint("fixed", "foot", "a") + "<link name='laser'/>" +
                     urdf_joint("fixed", "a", "laser") + extensions),
               "odd.urdf");
    ASSERT_EQ(the_robot(scene).links.size(), 1U) << keep;
    EXPECT_EQ(the_robot(scene).links[0].sensors.size(), 1U) << keep;
  }
}

TEST(Urdf, StandsWhenItsFirstLinkHasNoMass) {
  const SceneDescription scene =
      loaded(robot("<link name='a'/>" + heavy("b") + urdf_joint("continuous", "a", "b")), "odd.urdf");
  World world(scene, 0);
  world.advance(1, 0.005);
  EXPECT_NEAR(world.pose(world.tree().find("/r/a")).position.z(), 0, 1e-6);
  EXPECT_NEAR(world.pose(world.tree().find("/r/b")).position.z(), 2, 1e-3);
}

TEST(Urdf, WithoutALinkOfItsOwnIsReported) {
  EXPECT_TRUE(holds(reported_for(robot("<link name='world'/>"), "odd.urdf"), "contains no <link> except the world"));
}

TEST(Urdf, RunsWithoutWhatHangsOnALinkWithoutMass) {
  const SceneDescription scene = loaded(robot(heavy("a") + "<link name='b'/>" + heavy("c") +
                                              urdf_joint("continuous", "a", "b") + urdf_joint("continuous", "b", "c")),
                                        "odd.urdf");
  EXPECT_EQ(the_robot(scene).links.size(), 1U);
}

TEST(Urdf, WithANegativeMassIsRefused) {
  const std::string text = robot(
      "<link name='a'><inertial><mass value='-1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
      "</inertial></link>");
  EXPECT_TRUE(holds(reported_for(text, "odd.urdf"), "/r/a: the mass is -1 kg, it must be above 0"));
}

TEST(Urdf, ThatCannotBeParsedStatesWhy) {
  EXPECT_TRUE(
      holds(reported_for(robot(heavy("a") + urdf_joint("fixed", "a", "b")), "odd.urdf"), "child link [b] of joint"));
}

TEST(Urdf, FreesWhatMimicsAJointThatDoesNotMove) {
  const SceneDescription scene =
      loaded(robot(heavy("a") + heavy("b") + heavy("c") + urdf_joint("fixed", "a", "b") +
                   urdf_joint("continuous", "a", "c", "<axis xyz='0 0 1'/><mimic joint='a_b'/>")),
             "odd.urdf");
  ASSERT_EQ(the_robot(scene).joints.size(), 1U);
  EXPECT_FALSE(the_robot(scene).joints[0].axes[0].mimic);
}

TEST(Urdf, VelocityLimitsOfZeroAreNone) {
  const SceneDescription scene = loaded(robot(heavy("a") + heavy("b") + urdf_joint("revolute", "a", "b")), "odd.urdf");
  EXPECT_EQ(the_robot(scene).joints.at(0).axes.at(0).max_velocity, kInfinity);
  EXPECT_EQ(the_robot(scene).joints.at(0).axes.at(0).max_force, 0);
}

TEST(Urdf, FindsPackagesAsRoslaunchWritesThem) {
  const TemporaryFile manifest("package.xml", "<package><name>odd_robot</name></package>");
  std::ofstream(fs::path(manifest.folder()) / "wedge.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const std::string mesh = "<geometry><mesh filename='file://$(find odd_robot)/wedge.obj'/></geometry>";
  std::ofstream(fs::path(manifest.folder()) / "robot.urdf")
      << robot("<link name='a'>" + kInertial + "<collision>" + mesh + "</collision></link>");
  const SceneDescription scene = read_scene(manifest.folder() + "/robot.urdf");
  EXPECT_EQ(the_robot(scene).links[0].collisions.size(), 1U);
}

}  // namespace
}  // namespace bubblesim::test::test_odd_files
