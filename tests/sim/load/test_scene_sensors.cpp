// SPDX-License-Identifier: BSD-3-Clause
// Reading <sensor>.
#include <gtest/gtest.h>

#include "bubblesim/scene_loader.hpp"
#include "scene_files.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_scene_sensors {
namespace {

SensorDescription loaded(const std::string& sensor) {
  const TemporaryFile file("sensor.sdf", in_world("<model name='m'><link name='l'>" + sensor + "</link></model>"));
  return read_scene(file.path()).models.at(0).links.at(0).sensors.at(0);
}

std::string lidar(const std::string& type, const std::string& element) {
  return "<sensor name='s' type='" + type + "'><pose>0 0 0.2 0 0 1</pose><update_rate>10</update_rate><" + element +
         R"(>
      <scan><horizontal><samples>640</samples><resolution>1</resolution><min_angle>-2</min_angle><max_angle>1.5</max_angle>
      </horizontal><vertical><samples>16</samples><min_angle>-0.25</min_angle><max_angle>0.5</max_angle></vertical></scan>
      <range><min>0.08</min><max>12</max><resolution>0.01</resolution></range>
      <noise><type>gaussian</type><mean>0.1</mean><stddev>0.02</stddev><bias_mean>0.3</bias_mean>
      <bias_stddev>0.04</bias_stddev><precision>5</precision></noise></)" +
         element + "></sensor>";
}

class LidarOfAnyName : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(LidarOfAnyName, HoldsWhatTheFileStates) {
  const SensorDescription sensor = loaded(lidar(GetParam().first, GetParam().second));
  EXPECT_EQ(sensor.pose, Pose(0, 0, 0.2, 0, 0, 1));
  EXPECT_EQ(sensor.update_rate, 10);
  const auto& read = sensor.kind.get<LidarDescription>();
  EXPECT_EQ(read.horizontal.samples, 640);
  EXPECT_EQ(read.horizontal.min, -2);
  EXPECT_EQ(read.horizontal.max, 1.5);
  EXPECT_EQ(read.vertical.samples, 16);
  EXPECT_EQ(read.vertical.min, -0.25);
  EXPECT_EQ(read.vertical.max, 0.5);
  EXPECT_EQ(read.min_range, 0.08);
  EXPECT_EQ(read.max_range, 12);
  EXPECT_EQ(read.resolution, 0.01);
  EXPECT_EQ(read.noise.mean, 0.1);
  EXPECT_EQ(read.noise.stddev, 0.02);
  EXPECT_EQ(read.noise.bias_mean, 0.3);
  EXPECT_EQ(read.noise.bias_stddev, 0.04);
  EXPECT_EQ(read.noise.precision, 0) << "only of quantized noise";
}

INSTANTIATE_TEST_SUITE_P(Names, LidarOfAnyName,
                         ::testing::Values(std::pair("ray", "ray"), std::pair("gpu_ray", "ray"),
                                           std::pair("lidar", "lidar"), std::pair("gpu_lidar", "lidar")));

TEST(Lidar, OfAFileMultipliesSamplesByTheirResolution) {
  const SensorDescription sensor = loaded(
      "<sensor name='s' type='ray'><ray><scan><horizontal><samples>100</samples><resolution>0.5</resolution>"
      "<min_angle>0</min_angle><max_angle>1</max_angle></horizontal></scan><range><min>0</min><max>1</max></range>"
      "</ray></sensor>");
  EXPECT_EQ(sensor.kind.get<LidarDescription>().horizontal.samples, 50);
  EXPECT_EQ(sensor.kind.get<LidarDescription>().vertical.samples, 1);
}

std::string camera(const std::string& type, const std::string& more = "") {
  return "<sensor name='s' type='" + type + R"('><pose>1 0 0 0 0 0</pose>
      <camera><pose>0 2 0 0 0 0</pose><horizontal_fov>1.2</horizontal_fov>
      <image><width>64</width><height>48</height></image><clip><near>0.2</near><far>40</far></clip>
      <noise><type>gaussian_quantized</type><stddev>0.02</stddev><precision>0.5</precision></noise>)" +
         more + "</camera></sensor>";
}

TEST(Camera, OfAFileHoldsWhatTheFileStates) {
  const SensorDescription sensor = loaded(camera("camera", "<bubblesim:antialias>true</bubblesim:antialias>"));
  EXPECT_EQ(sensor.pose.position, Vector3(1, 2, 0));
  const auto& read = sensor.kind.get<CameraDescription>();
  EXPECT_EQ(read.width, 64);
  EXPECT_EQ(read.height, 48);
  EXPECT_EQ(read.horizontal_fov, 1.2);
  EXPECT_EQ(read.near, 0.2);
  EXPECT_EQ(read.far, 40);
  EXPECT_TRUE(read.color);
  EXPECT_TRUE(read.antialias);
  EXPECT_EQ(read.noise.stddev, 0.02);
  EXPECT_EQ(read.noise.precision, 0.5);
}

TEST(Camera, ForDepthHasNoColor) {
  EXPECT_FALSE(loaded(camera("depth_camera")).kind.get<CameraDescription>().color);
  EXPECT_FALSE(loaded(camera("depth")).kind.get<CameraDescription>().color);
  EXPECT_TRUE(loaded(camera("rgbd_camera")).kind.get<CameraDescription>().color);
  EXPECT_TRUE(loaded(camera("segmentation")).kind.get<CameraDescription>().color);
}

TEST(Camera, ForDepthMayHaveAClipOfItsOwn) {
  const SensorDescription sensor =
      loaded(camera("depth_camera", "<depth_camera><clip><near>0.5</near><far>7</far></clip></depth_camera>"));
  EXPECT_EQ(sensor.kind.get<CameraDescription>().near, 0.5);
  EXPECT_EQ(sensor.kind.get<CameraDescription>().far, 7);
}

TEST(Sonar, OfAFileHasTheVolumeNamed) {
  const auto volume = [](const std::string& element) {
    return loaded(
               "<sensor name='s' type='sonar'><sonar><min>0</min><max>1</max>"
               "<radius>0.1</radius>" +
               element + "</sonar></sensor>")
        .kind.get<SonarDescription>()
        .volume;
  };
  EXPECT_EQ(volume(""), ProximityVolume::kCone);
  EXPECT_EQ(volume("<bubblesim:volume>ray</bubblesim:volume>"), ProximityVolume::kRay);
  EXPECT_EQ(volume("<bubblesim:volume>cone</bubblesim:volume>"), ProximityVolume::kCone);
  EXPECT_EQ(volume("<bubblesim:volume>pyramid</bubblesim:volume>"), ProximityVolume::kPyramid);
  EXPECT_EQ(volume("<bubblesim:volume>disc</bubblesim:volume>"), ProximityVolume::kDisc);
  EXPECT_EQ(volume("<bubblesim:volume>cylinder</bubblesim:volume>"), ProximityVolume::kCylinder);
}

TEST(Sensors, OfAKindThatIsNotSimulatedAreLeftOutWithAWarning) {
  std::vector<Problem> warnings;
  const TemporaryFile file("air_speed.sdf", in_world("<model name='m'><link name='l'>\n<sensor name='s' "
                                                     "type='air_speed'/></link></model>"));
  const SceneDescription scene = read_scene(file.path(), {}, &warnings);
  const std::string warning = lines_of(warnings);
  EXPECT_TRUE(scene.models.at(0).links.at(0).sensors.empty());
  EXPECT_NE(warning.find("air_speed.sdf:2: /m/l/s: sensors of type 'air_speed' are not simulated"), std::string::npos)
      << warning;
}

TEST(AirPressure, HoldsWhatTheFileStates) {
  const SensorDescription sensor = loaded(
      "<sensor name='s' type='air_pressure'><air_pressure><reference_altitude>440</reference_altitude><pressure>"
      "<noise type='gaussian'><stddev>3</stddev></noise></pressure></air_pressure></sensor>");
  const auto& read = sensor.kind.get<AirPressureDescription>();
  EXPECT_EQ(read.reference_altitude, 440);
  EXPECT_EQ(read.pressure_noise.stddev, 3);
}

TEST(LogicalCamera, HoldsWhatTheFileStates) {
  const SensorDescription sensor = loaded(
      "<sensor name='s' type='logical_camera'><logical_camera><near>0.5</near><far>7</far>"
      "<aspect_ratio>1.5</aspect_ratio><horizontal_fov>1.1</horizontal_fov></logical_camera></sensor>");
  const auto& read = sensor.kind.get<LogicalCameraDescription>();
  EXPECT_EQ(read.near, 0.5);
  EXPECT_EQ(read.far, 7);
  EXPECT_EQ(read.aspect_ratio, 1.5);
  EXPECT_EQ(read.horizontal_fov, 1.1);
}

TEST(Altimeter, HoldsWhatTheFileStates) {
  const SensorDescription sensor = loaded(
      "<sensor name='s' type='altimeter'><altimeter><vertical_position><noise type='gaussian'><stddev>0.1</stddev>"
      "</noise></vertical_position><vertical_velocity><noise type='gaussian'><stddev>0.2</stddev></noise>"
      "</vertical_velocity></altimeter></sensor>");
  const auto& read = sensor.kind.get<AltimeterDescription>();
  EXPECT_EQ(read.position_noise.stddev, 0.1);
  EXPECT_EQ(read.velocity_noise.stddev, 0.2);
}

TEST(Magnetometer, HoldsWhatTheFileStates) {
  const SensorDescription sensor = loaded(
      "<sensor name='s' type='magnetometer'><magnetometer><y><noise type='gaussian'><stddev>1e-7</stddev></noise></y>"
      "</magnetometer></sensor>");
  const auto& read = sensor.kind.get<MagnetometerDescription>();
  EXPECT_EQ(read.field_noise[0].stddev, 0);
  EXPECT_EQ(read.field_noise[1].stddev, 1e-7);
}

TEST(Multicamera, IsACameraForEachOfItsOwn) {
  const auto camera = [](const std::string& name, const std::string& pose) {
    return "<camera name='" + name + "'><pose>" + pose + "</pose><horizontal_fov>1.3</horizontal_fov><image><width>8" +
           "</width><height>6</height></image><clip><near>0.1</near><far>9</far></clip></camera>";
  };
  const TemporaryFile file(
      "stereo.sdf",
      in_world("<model name='m'><link name='l'><sensor name='eyes' type='multicamera'><pose>1 0 0 0 0 0</pose>" +
               camera("left", "0 0.1 0 0 0 0") + camera("right", "0 -0.1 0 0 0 0") + "</sensor></link></model>"));
  const auto sensors = read_scene(file.path()).models.at(0).links.at(0).sensors;
  ASSERT_EQ(sensors.size(), 2U);
  EXPECT_EQ(sensors[0].name, "eyes_left");
  EXPECT_EQ(sensors[1].name, "eyes_right");
  EXPECT_EQ(sensors[1].pose, Pose(1, -0.1, 0, 0, 0, 0));
  EXPECT_EQ(sensors[1].kind.get<CameraDescription>().width, 8);
}

}  // namespace
}  // namespace bubblesim::test::test_scene_sensors
