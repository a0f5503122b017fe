// SPDX-License-Identifier: BSD-3-Clause
// What older versions of SDFormat mean by the same elements.
#include <gtest/gtest.h>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_versions {
namespace {

SceneDescription loaded(const std::string& text, std::vector<Problem>* warnings = nullptr) {
  const TemporaryFile file("old.world", text);
  return read_scene(file.path(), {}, warnings);
}

TEST(Version10, HasAttributesForValues) {
  const SceneDescription scene = loaded(R"(<gazebo version='1.0'><world name='w'>
<physics type='ode' update_rate='500'><gravity xyz='0 0 -5'/><ode><solver type='quick' dt='0.002' iters='10' sor='1.3'/>
</ode></physics>
<light type='directional' name='sun' cast_shadows='1'><origin pose='0 0 30 0 0 0'/><diffuse rgba='.5 .5 .5 1'/>
<direction xyz='0 0 -1'/></light>
<model name='m' static='0'><origin pose='1 2 3 0 0 0'/>
<link name='a' gravity='0'><origin pose='0 0 1 0 0 0'/><inertial mass='2'><inertia ixx='3' ixy='0' ixz='0' iyy='4' iyz='0'
 izz='5'/></inertial><collision name='c'><geometry><box size='1 2 3'/></geometry><surface><friction><ode mu='0.25'/></friction>
</surface></collision><sensor name='s' type='ray' update_rate='7'><ray><scan><horizontal samples='9' resolution='1'
 min_angle='-1' max_angle='1'/></scan><range min='0.1' max='5' resolution='0'/></ray></sensor></link>
<link name='b'/><joint name='j' type='revolute'><parent link='a'/><child link='b'/><axis xyz='0 1 0'><limit lower='-1'
 upper='1'/><dynamics damping='0.5'/></axis></joint></model></world></gazebo>)");
  EXPECT_EQ(scene.gravity, Vector3(0, 0, -5));
  EXPECT_EQ(scene.substep, 0.002);
  EXPECT_FLOAT_EQ(scene.environment.lights.at(0).diffuse.r, 0.5F);
  EXPECT_TRUE(scene.environment.lights.at(0).cast_shadows);
  const ModelDescription& model = scene.models.at(0);
  EXPECT_EQ(model.pose.position, Vector3(1, 2, 3));
  const LinkDescription& a = model.links.at(0);
  EXPECT_FALSE(a.gravity_enabled);
  EXPECT_EQ(a.pose.position, Vector3(0, 0, 1));
  EXPECT_EQ(a.mass, 2);
  EXPECT_EQ(a.inertia_diagonal, Vector3(3, 4, 5));
  EXPECT_EQ(std::get<Box>(a.collisions.at(0).geometry).size, Vector3(1, 2, 3));
  EXPECT_EQ(a.collisions.at(0).surface.mu, 0.25);
  EXPECT_EQ(a.sensors.at(0).update_rate, 7);
  EXPECT_EQ(a.sensors.at(0).kind.get<LidarDescription>().horizontal.samples, 9);
  const JointDescription& joint = model.joints.at(0);
  EXPECT_EQ(joint.parent, "a");
  EXPECT_EQ(joint.axes.at(0).upper, 1);
  EXPECT_EQ(joint.axes.at(0).damping, 0.5);
}

/// The direction of an axis along x, of a joint whose child is turned by a quarter about z.
Vector3 direction(const std::string& version, const std::string& more = "") {
  return loaded(
             "<sdf version='" + version +
             "'><world name='w'><model name='m'><link name='a'/><link name='b'><pose>0 0 0 0 0 1.5707963267948966"
             "</pose></link><joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz>" +
             more + "</axis></joint></model></world></sdf>")
      .models.at(0)
      .joints.at(0)
      .axes.at(0)
      .direction;
}

TEST(Version14, HasAxesInTheFrameOfTheModel) {
  EXPECT_LT((direction("1.4") - Vector3(0, -1, 0)).norm(), 1e-12);
  EXPECT_LT((direction("1.5") - Vector3(1, 0, 0)).norm(), 1e-12);
}

TEST(Version16, MayHaveAxesInTheFrameOfTheModel) {
  const std::string flag = "<use_parent_model_frame>1</use_parent_model_frame>";
  EXPECT_LT((direction("1.6", flag) - Vector3(0, -1, 0)).norm(), 1e-12);
}

TEST(Version15, HasGravityInPhysics) {
  const SceneDescription scene = loaded(
      "<sdf version='1.5'><world name='w'><physics type='ode'><gravity>0 0 -2</gravity></physics></world></sdf>");
  EXPECT_EQ(scene.gravity, Vector3(0, 0, -2));
}

TEST(Version15, HasOneNoiseForEachHalfOfAnImu) {
  const SceneDescription scene = loaded(
      "<sdf version='1.5'><world name='w'><model name='m'><link name='l'><sensor name='s' type='imu'><imu><noise>"
      "<type>gaussian</type><rate><mean>0</mean><stddev>0.1</stddev></rate><accel><mean>0</mean><stddev>0.2</stddev>"
      "<bias_mean>0.3</bias_mean></accel></noise></imu></sensor></link></model></world></sdf>");
  const auto& imu = scene.models.at(0).links.at(0).sensors.at(0).kind.get<ImuDescription>();
  for (const NoiseDescription& noise : imu.angular_velocity_noise) EXPECT_EQ(noise.stddev, 0.1);
  for (const NoiseDescription& noise : imu.linear_acceleration_noise) {
    EXPECT_EQ(noise.stddev, 0.2);
    EXPECT_EQ(noise.bias_mean, 0.3);
  }
}

TEST(Version, ThatIsNewerThanKnownIsReadWithAWarning) {
  std::vector<Problem> warnings;
  loaded("<sdf version='1.11'><world name='w'/></sdf>", &warnings);
  EXPECT_TRUE(warnings.empty()) << lines_of(warnings);
  loaded("<sdf version='1.99'><world name='w'/></sdf>", &warnings);
  EXPECT_NE(lines_of(warnings).find("SDFormat 1.99 is newer than 1.12"), std::string::npos);
}

}  // namespace
}  // namespace bubblesim::test::test_versions
