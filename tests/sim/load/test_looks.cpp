// SPDX-License-Identifier: BSD-3-Clause
// Textures, smooth meshes, lights and shadows in camera images: one ray, one pixel.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "bubblesim/simulation.hpp"
#include "bubblesim/triangle_mesh.hpp"
#include "scenes.hpp"
#include "surfaces.hpp"

namespace bubblesim::test::test_looks {
namespace {

using Rgb = std::array<double, 3>;

constexpr double kHalfLevel = 0.51 / 255;

/// The colour seen by a ray from the origin of `pose` along its x axis.
Rgb seen(const Pose& pose, std::vector<ModelDescription> models, const std::vector<Light>& lights,
         const Color& ambient = {}) {
  CameraDescription camera;
  camera.width = camera.height = 1;
  camera.horizontal_fov = 1e-4;
  camera.near = 0.01;
  SceneDescription described = with_sensor("Camera", camera, std::move(models), pose);
  described.environment.ambient = ambient;
  described.environment.lights = lights;
  Simulation simulation(described);
  const auto reading = simulation.read(simulation.world().tree().find("/Camera"));
  const auto& rgb = reading->measurement.get<CameraImage>().rgb;
  return {rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0};
}

void expect_color(const Rgb& found, const Rgb& expected) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], kHalfLevel);
}

const Color kFullyLit{1, 1, 1};
const Rgb kRed{1, 0, 0};
const Rgb kGreen{0, 1, 0};
const Rgb kBlue{0, 0, 1};
const Rgb kWhite{1, 1, 1};

/// Red and green above blue and white.
std::shared_ptr<const Texture> four_fields() {
  return std::make_shared<const Texture>(Texture{2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}});
}

ModelDescription showing(const VisualDescription& visual, const Pose& pose = {}) {
  ModelDescription thing = still(model("Thing", link("link"), pose));
  thing.links[0].visuals.push_back(visual);
  return thing;
}

VisualDescription visual(Geometry geometry, const Material& material = {}) {
  VisualDescription visual;
  visual.geometry = std::move(geometry);
  visual.material = material;
  return visual;
}

Material textured() {
  Material material;
  material.texture = four_fields();
  return material;
}

/// A square in the yz plane, 2 m wide, seen from -x; its texture is upright when looking along x.
TriangleMesh screen() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 1, -1}, {0, -1, -1}, {0, -1, 1}, {0, 1, 1}};
  mesh.texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(Texture, LiesUprightOnTheSidesOfABox) {
  const ModelDescription box = showing(visual(Box{{2, 2, 2}}, textured()));
  // Seen from each side, at the upper left of its centre: red.
  for (const double yaw : {0.0, M_PI / 2, M_PI, -M_PI / 2}) {
    const Pose eye = Pose(0, 0, 0, 0, 0, yaw) * at(-3, 0.5, 0.5);
    expect_color(seen(eye, {box}, {}, kFullyLit), kRed);
  }
  expect_color(seen(at(-3, -0.5, 0.5), {box}, {}, kFullyLit), kGreen);
  expect_color(seen(at(-3, 0.5, -0.5), {box}, {}, kFullyLit), kBlue);
  expect_color(seen(at(-3, -0.5, -0.5), {box}, {}, kFullyLit), kWhite);
}

TEST(Texture, BlendsBetweenTheMiddlesOfItsPixels) {
  const ModelDescription box = showing(visual(Box{{2, 2, 2}}, textured()));
  expect_color(seen(at(-3, 0, 0.5), {box}, {}, kFullyLit), {0.5, 0.5, 0});
}

TEST(Texture, OfAMeshFollowsItsCoordinates) {
  for (const bool is_static : {true, false}) {
    ModelDescription mesh = showing(visual(Mesh{finish_mesh(screen())}, textured()), Pose(4, 0, 1, 0, 0, 0));
    mesh.is_static = is_static;
    expect_color(seen(at(0, 0.5, 1.5), {mesh}, {}, kFullyLit), kRed);
    expect_color(seen(at(0, -0.5, 1.5), {mesh}, {}, kFullyLit), kGreen);
    expect_color(seen(at(0, 0.5, 0.5), {mesh}, {}, kFullyLit), kBlue);
    expect_color(seen(at(0, -0.5, 0.5), {mesh}, {}, kFullyLit), kWhite);
  }
}

TEST(MeshMaterials, CountUnlessTheVisualHasItsOwn) {
  TriangleMesh mesh = screen();
  mesh.materials.resize(2);
  mesh.materials[0].diffuse = {1, 0, 0};
  mesh.materials[1].diffuse = {0, 1, 0};
  mesh.material_of = {1, 0};
  VisualDescription shown = visual(Mesh{finish_mesh(mesh)});
  shown.material.diffuse = {0, 0, 1};
  const Pose lower_right = at(-3, -0.5, -0.6);  // on the first triangle
  expect_color(seen(lower_right, {showing(shown)}, {}, kFullyLit), kBlue);
  shown.keeps_mesh_materials = true;
  expect_color(seen(lower_right, {showing(shown)}, {}, kFullyLit), kGreen);
  expect_color(seen(at(-3, 0.5, 0.6), {showing(shown)}, {}, kFullyLit), kRed);
}

TEST(SmoothMesh, IsLitByItsOwnNormals) {
  Material white;
  white.diffuse = {1, 1, 1};
  Light along_x;
  along_x.direction = {1, 0, 0};
  along_x.diffuse = {1, 1, 1};
  TriangleMesh mesh = screen();
  // Turned by 1 rad at the lower corners, straight at the upper ones: at half height in between, along the sum of the
  // normals.
  const Vector3 tilted(-std::cos(1.0), 0, -std::sin(1.0));
  const TriangleMesh::Point low = {static_cast<float>(tilted.x()), 0, static_cast<float>(tilted.z())};
  mesh.normals = {low, low, {-1, 0, 0}, {-1, 0, 0}};
  const double halfway = std::cos(0.5);
  for (const double yaw : {0.0, 0.7}) {
    const Pose turned(0, 0, 0, 0, 0, yaw);
    Light light = along_x;
    light.direction = turned.orientation * light.direction;
    ModelDescription moving = showing(visual(Mesh{finish_mesh(mesh)}, white), turned);
    moving.is_static = yaw == 0.0;
    const Rgb found = seen(turned * at(-3, 0.3, 0), {moving}, {light});
    EXPECT_NEAR(found[0], halfway, kHalfLevel);
  }
}

/// The colour of white ground directly below a camera.
double on_the_ground(const Light& light, std::vector<ModelDescription> others = {}) {
  Material white;
  white.diffuse = {1, 1, 1};
  others.push_back(showing(visual(Plane{}, white)));
  return seen(Pose(0, 0, 0.5, 0, M_PI / 2, 0), std::move(others), {light})[0];
}

Light lamp(const Vector3& position, LightKind kind = LightKind::kPoint) {
  Light light;
  light.kind = kind;
  light.diffuse = {1, 1, 1};
  light.position = position;
  light.direction = {0, 0, -1};
  return light;
}

TEST(PointLight, FallsOffWithDistanceAndSlant) {
  Light light = lamp({0, 0, 2});
  EXPECT_NEAR(on_the_ground(light), 1, kHalfLevel);
  light.linear_attenuation = 0.5;
  light.quadratic_attenuation = 0.25;
  EXPECT_NEAR(on_the_ground(light), 1 / (1 + 0.5 * 2 + 0.25 * 4), kHalfLevel);
  light.position = {3, 0, 4};  // 5 m away
  EXPECT_NEAR(on_the_ground(light), 0.8 / (1 + 0.5 * 5 + 0.25 * 25), kHalfLevel);
}

TEST(PointLight, EndsAtItsRange) {
  Light light = lamp({0, 0, 2});
  light.range = 1.9;
  EXPECT_EQ(on_the_ground(light), 0);
}

TEST(PointLight, IsShadedByWhatStandsInBetweenAlone) {
  const Light light = lamp({0, 3, 3});
  const auto ball = [](double y, double z) {
    ModelDescription described = showing(visual(Sphere{0.2}), at(0, y, z));
    described.name = "Ball";
    return described;
  };
  const double lit = on_the_ground(light);
  EXPECT_GT(lit, 0.5);
  EXPECT_EQ(on_the_ground(light, {ball(1.5, 1.5)}), 0);
  EXPECT_EQ(on_the_ground(light, {ball(4, 4)}), lit);
}

TEST(Spotlight, IsBrightInItsInnerConeAndFadesInItsOuter) {
  const auto at_angle = [](double angle) {
    Light light = lamp({2 * std::tan(angle), 0, 2}, LightKind::kSpot);
    light.inner_angle = 0.4;
    light.outer_angle = 1.2;
    light.falloff = 2;
    return on_the_ground(light);
  };
  EXPECT_NEAR(at_angle(0.1), std::cos(0.1), kHalfLevel);
  const double part = (std::cos(0.4) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
  EXPECT_NEAR(at_angle(0.4), std::cos(0.4) * part * part, kHalfLevel);
  EXPECT_EQ(at_angle(0.61), 0);
}

TEST(Shadow, IsNotThrownByVisualsThatStateIt) {
  for (const Geometry& geometry :
       {Geometry(Sphere{0.2}), Geometry(Box{{0.3, 0.3, 0.3}}), Geometry(box_mesh({0.3, 0.3, 0.3}))}) {
    ModelDescription thing = showing(visual(geometry), at(1, 0, 1));
    thing.name = "Over";
    Light light;
    light.direction = {-1, 0, -1};
    EXPECT_EQ(on_the_ground(light, {thing}), 0);
    thing.links[0].visuals[0].cast_shadows = false;
    EXPECT_GT(on_the_ground(light, {thing}), 0.5);
  }
}

TEST(Lamp, OfALinkGoesWithIt) {
  CameraDescription camera;
  camera.width = camera.height = 1;
  camera.horizontal_fov = 1e-4;
  camera.near = 0.01;
  ModelDescription carrier = model("Carrier", link("link"), Pose(0, 0, 1, 0, 0, 0));
  Light lamp;
  lamp.kind = LightKind::kSpot;
  lamp.diffuse = kFullyLit;
  lamp.direction = Vector3::UnitX();
  lamp.inner_angle = lamp.outer_angle = 0.5;
  carrier.links[0].lights.push_back(lamp);
  Material white;
  white.diffuse = kFullyLit;
  // The light points forward; the camera, at the same place, looks down at a white floor.
  SceneDescription described =
      with_sensor("Camera", camera, {showing(visual(Box{{9, 9, 0.1}}, white), Pose(0, 0, -0.05, 0, 0, 0)), carrier},
                  Pose(0, 0, 1, 0, M_PI / 2, 0));
  described.environment.lights.clear();
  described.environment.ambient = {};
  Simulation simulation(described);
  const ObjectId eye = simulation.world().tree().find("/Camera");
  const auto red = [&] { return int{simulation.measure(eye)->measurement.get<CameraImage>().rgb[0]}; };
  EXPECT_EQ(red(), 0);
  simulation.world().set_pose(simulation.world().tree().find("/Carrier"), Pose(0, 0, 1, 0, M_PI / 2, 0));
  EXPECT_EQ(red(), 255);
}

}  // namespace
}  // namespace bubblesim::test::test_looks
