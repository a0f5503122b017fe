// SPDX-License-Identifier: BSD-3-Clause
// Pictures compared with a slow renderer in double precision.
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "bubblesim/simulation.hpp"
#include "reference_picture.hpp"
#include "scenes.hpp"
#include "surfaces.hpp"

namespace bubblesim::test::test_picture {
namespace {

constexpr int kWidth = 101;  // neither size is a whole number of packets
constexpr int kHeight = 67;

VisualDescription painted(Geometry geometry, const Color& color) {
  VisualDescription visual;
  visual.geometry = std::move(geometry);
  visual.material.diffuse = color;
  return visual;
}

ModelDescription thing(const std::string& name, const VisualDescription& visual, const Pose& pose, bool moves = false) {
  ModelDescription thing = model(name, link("link"), pose);
  thing.links[0].visuals.push_back(visual);
  thing.is_static = !moves;
  return thing;
}

std::shared_ptr<const Texture> texture() {
  auto made = std::make_shared<Texture>();
  made->width = 5;
  made->height = 3;
  for (int i = 0; i < 45; ++i) made->rgb.push_back(static_cast<std::uint8_t>(i * 97 % 256));
  return made;
}

/// A textured octahedron of radius 1 with the normals of a sphere.
Mesh smooth_gem() {
  TriangleMesh mesh;
  for (const float side : {1.0F, -1.0F}) {
    mesh.vertices.insert(mesh.vertices.end(), {{side, 0, 0}, {0, side, 0}, {0, 0, side}});
    mesh.texture_coordinates.insert(mesh.texture_coordinates.end(), {{side, 0.1F}, {0.3F, side}, {1.7F * side, 2}});
  }
  mesh.normals = mesh.vertices;
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  mesh.low = {-1, -1, -1};
  mesh.high = {1, 1, 1};
  return Mesh{std::make_shared<const TriangleMesh>(std::move(mesh))};
}

std::vector<ModelDescription> things() {
  VisualDescription ground = painted(Plane{}, {0.8F, 0.7F, 0.6F});
  ground.material.checker_size = 0.7;
  ground.material.checker_color = {0.2F, 0.3F, 0.25F};
  VisualDescription crate = painted(Box{{1, 1.4, 1.2}}, {1, 1, 1});
  crate.material.texture = texture();
  VisualDescription ball = painted(Sphere{0.6}, {0.9F, 0.2F, 0.1F});
  ball.material.checker_size = 0.25;
  ball.material.checker_color = {0.1F, 0.2F, 0.9F};
  ball.material.emissive = {0.05F, 0, 0.1F};
  VisualDescription ghost = painted(Capsule{0.3, 0.8}, {0.3F, 0.8F, 0.4F});
  ghost.cast_shadows = false;
  VisualDescription gem = painted(smooth_gem(), {1, 1, 1});
  gem.material.texture = texture();
  return {thing("Ground", ground, {}),
          thing("Crate", crate, Pose(4, 1.5, 0.7, 0.1, 0.2, 0.5)),
          thing("Ball", ball, Pose(3, -0.4, 0.8, 1, 2, 3), true),
          thing("Pole", painted(Cylinder{0.2, 2.5}, {0.4F, 0.5F, 0.9F}), Pose(5.5, -0.5, 1.3, 0, 0.1, 0)),
          thing("Ghost", ghost, Pose(3.5, -2, 0.9, 0.4, 0.3, 0), true),
          thing("Egg", painted(Ellipsoid{{0.4, 0.7, 0.3}}, {0.9F, 0.9F, 0.3F}), Pose(6, 0.8, 2.2, 0.3, 0.5, 0.7), true),
          thing("Gem", gem, Pose(6, -2.6, 1.2, 0.2, 0.4, 0.9), true),
          thing("Block", painted(box_mesh({0.6, 0.8, 2}), {0.6F, 0.6F, 0.7F}), Pose(7, 2.6, 1.1, 0, 0, 0.6)),
          thing("Bar", painted(Box{{0.3, 3, 0.2}}, {0.7F, 0.3F, 0.6F}), Pose(5, 0.3, 3, 0.2, 0.1, 0.4), true)};
}

/// One of each kind of light.
std::vector<Light> all_lights() {
  Light sun;
  sun.direction = {0.4, 0.3, -1};
  sun.diffuse = {0.4F, 0.35F, 0.3F};
  Light bulb;
  bulb.kind = LightKind::kPoint;
  bulb.position = {2, 2.5, 3};
  bulb.diffuse = {0.5F, 0.5F, 0.9F};
  bulb.range = 6;
  bulb.linear_attenuation = 0.1;
  bulb.quadratic_attenuation = 0.05;
  Light spot = bulb;
  spot.kind = LightKind::kSpot;
  spot.position = {1, -3, 4};
  spot.direction = {2.5, 2, -4};
  spot.range = 20;
  spot.diffuse = {0.9F, 0.6F, 0.5F};
  spot.inner_angle = 0.5;
  spot.outer_angle = 0.9;
  spot.falloff = 1.7;
  Light fill;
  fill.direction = {1, -0.5, -0.2};
  fill.diffuse = {0.1F, 0.15F, 0.1F};
  fill.cast_shadows = false;
  return {sun, bulb, spot, fill};
}

CameraDescription camera() {
  CameraDescription camera;
  camera.width = kWidth;
  camera.height = kHeight;
  camera.horizontal_fov = 1.3;
  camera.near = 0.2;
  camera.far = 40;
  return camera;
}

const Pose kEye(-0.5, 0.2, 1.7, 0.05, 0.15, -0.06);

SceneDescription lit_things(const CameraDescription& camera) {
  SceneDescription scene = with_sensor("Camera", camera, things(), kEye);
  scene.environment.ambient = {0.25F, 0.2F, 0.3F};
  scene.environment.background = {0.2F, 0.4F, 0.6F};
  scene.environment.lights = all_lights();
  return scene;
}

/// At edges a ray may meet either surface: a pixel must be as its centre or as a point a five hundredth of a pixel
/// beside it.
constexpr double kBeside = 2e-3;
constexpr std::array<std::array<double, 2>, 9> kTries = {{{0, 0},
                                                          {kBeside, 0},
                                                          {-kBeside, 0},
                                                          {0, kBeside},
                                                          {0, -kBeside},
                                                          {kBeside, kBeside},
                                                          {-kBeside, kBeside},
                                                          {kBeside, -kBeside},
                                                          {-kBeside, -kBeside}}};

bool same_color(const Vector3& expected, const std::uint8_t* found) {
  for (int i = 0; i < 3; ++i) {
    const double level = std::round(255 * std::clamp(expected[i], 0.0, 1.0));
    if (std::abs(level - found[i]) > 1) return false;
  }
  return true;
}

struct Taken {
  explicit Taken(const SceneDescription& scene, std::uint64_t seed = 0) : simulation(scene, seed) {
    reading = simulation.read(simulation.world().tree().find("/Camera"));
  }
  const CameraImage& image() const { return reading->measurement.get<CameraImage>(); }

  Simulation simulation;
  std::shared_ptr<const Reading> reading;
};

void expect_as_reference(const SceneDescription& scene, const CameraDescription& camera) {
  const Taken taken(scene);
  const CameraImage& image = taken.image();
  const ReferencePicture reference(scene, camera, kEye);
  std::vector<std::size_t> pixels(scene.models.size() + 1);
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const auto i = static_cast<std::size_t>(row * kWidth + column);
      ReferencePixel centre;
      const bool found = std::any_of(kTries.begin(), kTries.end(), [&](const std::array<double, 2>& beside) {
        centre = reference.at(column + 0.5 + beside[0], row + 0.5 + beside[1]);
        const bool nothing = std::isinf(centre.depth) && std::isinf(image.depth[i]);
        const ObjectId link =
            centre.object == 0
                ? kNoObject
                : taken.simulation.world().tree().find("/" + scene.models[centre.object - 1].name + "/link");
        return same_color(centre.rgb, &image.rgb[3 * i]) && link == image.objects[i] &&
               (nothing || std::abs(centre.depth - static_cast<double>(image.depth[i])) < 2e-3 * centre.depth);
      });
      EXPECT_TRUE(found) << "column " << column << ", row " << row << ": object " << image.objects[i] << ", depth "
                         << image.depth[i] << ", rgb " << int{image.rgb[3 * i]} << " " << int{image.rgb[3 * i + 1]}
                         << " " << int{image.rgb[3 * i + 2]} << "; expected " << centre.rgb * 255 << " at "
                         << centre.depth;
      ++pixels[centre.object];
    }
  }
  for (std::size_t object = 0; object + 1 < pixels.size(); ++object) {  // the last model carries the camera
    EXPECT_GT(pixels[object], 20U) << "too little is visible of model " << object;
  }
}

TEST(Picture, OfAllShapesUnderAllLightsIsThatOfASlowRenderer) { expect_as_reference(lit_things(camera()), camera()); }

TEST(Picture, UnderTheSkyWithoutShadowsIsThatOfASlowRenderer) {
  SceneDescription scene = lit_things(camera());
  scene.environment.sky = true;
  scene.environment.shadows = false;
  expect_as_reference(scene, camera());
}

TEST(Picture, FarFromTheOriginIsThatOfASlowRenderer) {
  SceneDescription scene = lit_things(camera());
  const Pose far(64, -128, 0, 0, 0, 0);  // exact in single precision
  for (ModelDescription& model : scene.models) model.pose = far * model.pose;
  for (Light& light : scene.environment.lights) light.position += far.position;
  scene.models[0].pose = Pose();
  const Taken taken(scene);
  const ReferencePicture reference(scene, camera(), far * kEye);
  std::size_t differing = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const std::uint8_t* rgb = &taken.image().rgb[3 * static_cast<std::size_t>(row * kWidth + column)];
      if (!same_color(reference.at(column + 0.5, row + 0.5).rgb, rgb)) ++differing;
    }
  }
  EXPECT_LE(differing, 10U) << "only pixels on edges may differ";
}

TEST(Picture, WithFourRaysInEachPixelIsTheirMean) {
  CameraDescription fine = camera();
  fine.antialias = true;
  const SceneDescription scene = lit_things(fine);
  const Taken taken(scene);
  const ReferencePicture reference(scene, fine, kEye);
  std::size_t differing = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const std::uint8_t* rgb = &taken.image().rgb[3 * static_cast<std::size_t>(row * kWidth + column)];
      if (!same_color(reference.of_four(column, row), rgb)) ++differing;
    }
  }
  EXPECT_LE(differing, 10U) << "only pixels on edges may differ";
}

TEST(Picture, IsTheSameWhenSeveralSensorsAreDueTogether) {
  SceneDescription scene = lit_things(camera());
  std::vector<SensorDescription>& sensors = scene.models.back().links[0].sensors;
  sensors.push_back(sensors[0]);
  sensors.back().name = "Second";
  LidarDescription lidar;
  lidar.horizontal = {300, -3, 3};
  lidar.max_range = 30;
  sensors.push_back({});
  sensors.back().name = "Lidar";
  sensors.back().kind = lidar;
  Simulation together(scene);
  Simulation alone(scene);
  const auto find = [&](const char* name) { return together.world().tree().find(name); };
  for (const char* name : {"/Camera", "/Second", "/Lidar"}) together.read(find(name));
  together.step();
  alone.step();
  EXPECT_EQ(together.measurements(), 6U) << "all three were due in the step";
  for (const char* name : {"/Camera", "/Second"}) {
    const auto one = together.read(find(name));
    const auto other = alone.read(find(name));
    EXPECT_EQ(one->measurement.get<CameraImage>().rgb, other->measurement.get<CameraImage>().rgb);
    EXPECT_EQ(one->measurement.get<CameraImage>().depth, other->measurement.get<CameraImage>().depth);
  }
  EXPECT_EQ(together.read(find("/Lidar"))->measurement.get<LidarScan>().ranges,
            alone.read(find("/Lidar"))->measurement.get<LidarScan>().ranges);
}

TEST(Picture, IsTheSameEachTimeAlsoWithNoise) {
  CameraDescription noisy = camera();
  noisy.noise.stddev = 0.05;
  EXPECT_EQ(Taken(lit_things(noisy), 5).image().rgb, Taken(lit_things(noisy), 5).image().rgb);
  EXPECT_NE(Taken(lit_things(noisy), 5).image().rgb, Taken(lit_things(noisy), 6).image().rgb);
}

}  // namespace
}  // namespace bubblesim::test::test_picture
