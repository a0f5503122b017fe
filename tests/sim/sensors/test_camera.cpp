// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_camera {
namespace {

constexpr double kExact = 1e-4;  // m
constexpr int kWidth = 40;
constexpr int kHeight = 30;

VisualDescription colored(Geometry geometry, const Color& color, const Pose& pose = {}) {
  VisualDescription visual;
  visual.name = "visual";
  visual.geometry = std::move(geometry);
  visual.material.diffuse = color;
  visual.pose = pose;
  return visual;
}

ModelDescription thing(const std::string& name, const VisualDescription& visual, const Pose& pose = {}) {
  ModelDescription thing = still(model(name, link("link"), pose));
  thing.links[0].visuals.push_back(visual);
  return thing;
}

/// A camera that looks along x from the origin, unless its model is moved.
SceneDescription with_camera(const CameraDescription& camera, std::vector<ModelDescription> others,
                             const Pose& pose = {}) {
  return with_sensor("Camera", camera, std::move(others), pose);
}

CameraDescription camera(bool color = true) {
  CameraDescription camera;
  camera.width = kWidth;
  camera.height = kHeight;
  camera.horizontal_fov = M_PI / 2;
  camera.near = 0.1;
  camera.far = 50;
  camera.color = color;
  return camera;
}

using Rgb = std::array<int, 3>;

class Picture {
 public:
  explicit Picture(const SceneDescription& scene) {
    Simulation simulation(scene);
    reading_ = simulation.read(simulation.world().tree().find("/Camera"));
  }
  const CameraImage* operator->() const { return &reading_->measurement.get<CameraImage>(); }
  double depth(int column, int row) const { return (*this)->depth.at(index(column, row)); }
  ObjectId object(int column, int row) const { return (*this)->objects.at(index(column, row)); }
  Rgb rgb(int column, int row) const {
    const std::uint8_t* pixel = &(*this)->rgb.at(3 * index(column, row));
    return {pixel[0], pixel[1], pixel[2]};
  }

 private:
  std::size_t index(int column, int row) const { return static_cast<std::size_t>(row * (*this)->width + column); }

  std::shared_ptr<const Reading> reading_;
};

Rgb bytes(double r, double g, double b) {
  const auto level = [](double value) { return static_cast<int>(std::lround(255 * value)); };
  return {level(r), level(g), level(b)};
}

/// Rows of pixels had the colours of the other squares: the ray's length is a number of single precision.
TEST(Checkerboard, IsRightFromAnyHeight) {
  constexpr double kSize = 0.5;     // m
  constexpr double kPitch = 0.6;    // rad
  constexpr double kBorder = 1e-3;  // of a square, within which either colour is right
  VisualDescription ground = colored(Plane{}, {});
  ground.material.checker_size = kSize;
  ground.material.checker_color = {1, 1, 1};
  for (double height = 0.5; height < 20; height += 0.31) {
    SceneDescription scene = with_camera(camera(), {thing("Ground", ground)}, Pose(0.1, 0.2, height, 0, kPitch, 0.4));
    scene.environment.ambient = {1, 1, 1};
    const Picture picture(scene);
    int wrong = 0;
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        if (picture.object(column, row) == kNoObject) continue;
        const double left = (kWidth / 2.0 - column - 0.5) / (kWidth / 2.0);
        const double up = (kHeight / 2.0 - row - 0.5) / (kWidth / 2.0);
        const double forward = std::cos(kPitch) + std::sin(kPitch) * up;
        const double length = height / (std::sin(kPitch) - std::cos(kPitch) * up);
        const double x = (0.1 + length * (std::cos(0.4) * forward - std::sin(0.4) * left)) / kSize;
        const double y = (0.2 + length * (std::sin(0.4) * forward + std::cos(0.4) * left)) / kSize;
        if (std::abs(x - std::round(x)) < kBorder || std::abs(y - std::round(y)) < kBorder) continue;
        const bool is_odd = std::fmod(std::abs(std::floor(x) + std::floor(y)), 2) == 1;
        if (is_odd != (picture.rgb(column, row)[0] > 127)) ++wrong;
      }
    }
    EXPECT_EQ(wrong, 0) << "from " << height << " m";
  }
}

TEST(Depth, IsMeasuredAlongTheAxis) {
  const Picture picture(with_camera(camera(false), {thing("Wall", colored(Box{{1, 99, 99}}, {}), at(3.5, 0, 0))}));
  EXPECT_TRUE(picture->rgb.empty());
  for (const float depth : picture->depth) EXPECT_NEAR(depth, 3, kExact);
}

TEST(Depth, OfTheGroundFollowsThePinholesLaw) {
  const Picture picture(with_camera(camera(false), {thing("Ground", colored(Plane{}, {}))}, at(0, 0, 1)));
  const double focal = kWidth / 2.0;  // of 90 degrees
  for (int row = 0; row < kHeight; ++row) {
    const double down = (row + 0.5 - kHeight / 2.0) / focal;
    for (int column = 0; column < kWidth; ++column) {
      if (down < 0) {
        EXPECT_EQ(picture.depth(column, row), INFINITY);
      } else {
        EXPECT_NEAR(picture.depth(column, row), 1 / down, 1e-5 / down);
      }
    }
  }
}

TEST(Depth, IsThatOfWhatLiesBetweenTheNearAndTheFarPlane) {
  CameraDescription close = camera(false);
  close.near = 4;
  const ModelDescription wall = thing("Wall", colored(Box{{1, 99, 99}}, {}), at(3.5, 0, 0));
  const ModelDescription behind = thing("Behind", colored(Box{{1, 99, 99}}, {}), at(9.5, 0, 0));
  EXPECT_EQ(Picture(with_camera(close, {wall})).depth(0, 0), INFINITY);
  EXPECT_NEAR(Picture(with_camera(close, {wall, behind})).depth(0, 0), 9, kExact);
  close.far = 2.9;
  close.near = 0.1;
  EXPECT_EQ(Picture(with_camera(close, {wall})).depth(0, 0), INFINITY);
}

TEST(Picture, LeavesOutWhatIsNearerThanItsNearPlane) {
  CameraDescription far_only = camera();
  far_only.near = 4;
  SceneDescription described = with_camera(far_only, {thing("Wall", colored(Box{{1, 99, 99}}, {}), at(3.5, 0, 0))});
  described.environment.background = {0, 0, 1};
  EXPECT_EQ(Picture(described).rgb(20, 15), (Rgb{0, 0, 255}));
}

TEST(Picture, HasTheUpperLeftFirst) {
  // Left is +y, up is +z. At 2 m the image is 4 m wide.
  const Picture picture(with_camera(camera(), {thing("UpperLeft", colored(Sphere{0.3}, {}), at(2, 1, 1))}));
  const ObjectId seen = picture.object(10, 5);
  EXPECT_NE(seen, kNoObject);
  EXPECT_EQ(picture.object(29, 5), kNoObject);
  EXPECT_EQ(picture.object(10, 24), kNoObject);
  EXPECT_EQ(picture.object(29, 24), kNoObject);
}

TEST(Picture, GivesTheLinkInEachPixel) {
  SceneDescription described = with_camera(camera(), {thing("Left", colored(Box{{1, 50, 99}}, {}), at(3, 25, 0)),
                                                      thing("Right", colored(Box{{1, 50, 99}}, {}), at(4, -25, 0))});
  Simulation simulation(described);
  const auto reading = simulation.read(simulation.world().tree().find("/Camera"));
  const auto& objects = reading->measurement.get<CameraImage>().objects;
  EXPECT_EQ(objects[0], simulation.world().tree().find("/Left/link"));
  EXPECT_EQ(objects[kWidth - 1], simulation.world().tree().find("/Right/link"));
}

TEST(Picture, FollowsTheFieldOfView) {
  CameraDescription narrow = camera();
  narrow.horizontal_fov = 2 * std::atan(0.5);
  // A wall 2 m ahead that ends in the image centre on the left and 0.5 m to the right of it: a quarter of the visible 2
  // m.
  const Picture picture(with_camera(narrow, {thing("Wall", colored(Box{{1, 0.5, 99}}, {}), at(2.5, -0.25, 0))}));
  EXPECT_EQ(picture.object(19, 15), kNoObject);
  EXPECT_NE(picture.object(20, 15), kNoObject);
  EXPECT_NE(picture.object(29, 15), kNoObject);
  EXPECT_EQ(picture.object(30, 15), kNoObject);
}

Light shining(const Vector3& direction, const Color& color) {
  Light light;
  light.direction = direction;
  light.diffuse = color;
  return light;
}

/// A camera 2 m above the ground that looks down, with one light.
SceneDescription ground_under(const Vector3& light, std::vector<ModelDescription> others = {}) {
  others.push_back(thing("Ground", colored(Plane{}, {0.8F, 0.6F, 0.4F})));
  SceneDescription described = with_camera(camera(), others, Pose(0, 0, 2, 0, M_PI / 2, 0));
  described.environment.ambient = {0.2F, 0.2F, 0.3F};
  described.environment.lights = {shining(light, {0.5F, 0.6F, 0.7F})};
  return described;
}

TEST(Light, FollowsLambertsLaw) {
  for (const double tilt : {0.0, 0.5, 1.2}) {
    const Picture picture(ground_under({std::sin(tilt), 0, -std::cos(tilt)}));
    const double c = std::cos(tilt);
    EXPECT_EQ(picture.rgb(20, 15), bytes(0.8 * (0.2 + 0.5 * c), 0.6 * (0.2 + 0.6 * c), 0.4 * (0.3 + 0.7 * c))) << tilt;
  }
}

TEST(Light, FromBelowLeavesAmbient) {
  EXPECT_EQ(Picture(ground_under({0, 0, 1})).rgb(20, 15), bytes(0.8 * 0.2, 0.6 * 0.2, 0.4 * 0.3));
}

TEST(Light, ThrowsAShadowBesideAThing) {
  // The top of a pole at (-1, 0, 1) shades the origin from light along (1, 0, -1).
  const ModelDescription ball = thing("Ball", colored(Sphere{0.2}, {}), at(-1, 0, 1));
  const Rgb ambient = bytes(0.8 * 0.2, 0.6 * 0.2, 0.4 * 0.3);
  SceneDescription described = ground_under({1, 0, -1}, {ball});
  EXPECT_EQ(Picture(described).rgb(20, 15), ambient);
  described.environment.lights[0].cast_shadows = false;
  const Rgb lit = Picture(described).rgb(20, 15);
  EXPECT_GT(lit[0], ambient[0]);
  described.environment.lights[0].cast_shadows = true;
  described.environment.shadows = false;
  EXPECT_EQ(Picture(described).rgb(20, 15), lit);
}

TEST(Light, ShadesASphereByItsTrueNormal) {
  SceneDescription described = with_camera(camera(), {thing("Ball", colored(Sphere{1}, {1, 1, 1}), at(3, 0, 0))});
  described.environment.ambient = {};
  described.environment.lights = {shining({1, 0, 0}, {1, 1, 1})};
  const Picture picture(described);
  for (const int column : {15, 18, 20, 23}) {
    // The pixel's ray d = (1, l, u) meets |t d - (3, 0, 0)| = 1 first at t; the normal there is t d - (3, 0, 0).
    const double l = (kWidth / 2.0 - column - 0.5) / (kWidth / 2.0);
    const double u = (kHeight / 2.0 - 15.5) / (kWidth / 2.0);
    const double a = 1 + l * l + u * u;
    const double t = (3 - std::sqrt(9 - 8 * a)) / a;
    const double cosine = 3 - t;
    EXPECT_NEAR(picture.rgb(column, 15)[0], 255 * cosine, 0.51) << column;
  }
}

TEST(Light, OfAMaterialOfItsOwnNeedsNoOther) {
  VisualDescription lamp = colored(Box{{1, 99, 99}}, {0, 0, 0});
  lamp.material.emissive = {0.25F, 0.5F, 1};
  EXPECT_EQ(Picture(with_camera(camera(), {thing("Lamp", lamp, at(3, 0, 0))})).rgb(0, 0), bytes(0.25, 0.5, 1));
}

TEST(Background, ShowsWhereNothingIs) {
  SceneDescription described = with_camera(camera(), {});
  described.environment.background = {0.2F, 0.4F, 0.6F};
  EXPECT_EQ(Picture(described).rgb(3, 3), bytes(0.2, 0.4, 0.6));
}

TEST(Sky, IsTheDeeperBlueTheHigherOneLooks) {
  SceneDescription described = with_camera(camera(), {});
  described.environment.sky = true;
  const Picture picture(described);
  EXPECT_LT(picture.rgb(20, 0)[0], picture.rgb(20, 14)[0]);
  EXPECT_GT(picture.rgb(20, 0)[2], picture.rgb(20, 0)[0]);
}

TEST(Checker, AlternatesInTheShapesFrame) {
  VisualDescription board = colored(Box{{0.2, 40, 40}}, {1, 1, 1});
  board.material.checker_size = 1;
  board.material.checker_color = {0, 0, 0};
  SceneDescription described = with_camera(camera(), {thing("Board", board, at(2.1, 0, 0))});
  described.environment.ambient = {1, 1, 1};
  described.environment.lights = {};
  const Picture picture(described);
  // 2 m ahead a pixel is 0.1 m: squares of 10 pixels, with a corner at the image centre.
  EXPECT_NE(picture.rgb(15, 10), picture.rgb(25, 10));
  EXPECT_NE(picture.rgb(15, 10), picture.rgb(15, 20));
  EXPECT_EQ(picture.rgb(15, 10), picture.rgb(25, 20));
  EXPECT_EQ(picture.rgb(10, 10), picture.rgb(19, 14)) << "all of one square";
  EXPECT_NE(picture.rgb(9, 10), picture.rgb(10, 10)) << "the next square";
}

TEST(Antialias, MixesWhatMeetsInAPixel) {
  // A wall that ends in the middle of column 20.
  CameraDescription fine = camera();
  fine.antialias = true;
  SceneDescription described =
      with_camera(fine, {thing("Wall", colored(Box{{1, 50, 99}}, {1, 1, 1}), at(2.5, 25 - 0.05, 0))});
  described.environment.ambient = {1, 1, 1};
  described.environment.lights = {};
  described.environment.background = {0, 0, 0};
  const Picture picture(described);
  EXPECT_EQ(picture.rgb(19, 15), (Rgb{255, 255, 255}));
  EXPECT_EQ(picture.rgb(20, 15), (Rgb{128, 128, 128}));
  EXPECT_EQ(picture.rgb(21, 15), (Rgb{0, 0, 0}));
}

TEST(CameraNoise, HasTheDeviationAsked) {
  CameraDescription noisy = camera();
  noisy.noise.stddev = 0.05;
  SceneDescription described = with_camera(noisy, {});
  described.environment.background = {0.5F, 0.5F, 0.5F};
  const Picture picture(described);
  double sum = 0;
  double squares = 0;
  for (const std::uint8_t level : picture->rgb) {
    sum += level / 255.0;
    squares += level / 255.0 * level / 255.0;
  }
  const auto count = static_cast<double>(picture->rgb.size());
  const double mean = sum / count;
  EXPECT_NEAR(mean, 0.5, 5 * 0.05 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 0.05, 5 * 0.05 / std::sqrt(2 * count));
}

TEST(CameraNoise, OfADepthCameraIsInMetres) {
  CameraDescription noisy = camera(false);
  noisy.noise.mean = 0.25;
  const Picture picture(with_camera(noisy, {thing("Wall", colored(Box{{1, 99, 40}}, {}), at(3.5, 0, -20))}));
  EXPECT_NEAR(picture.depth(20, 29), 3.25, kExact);
  EXPECT_EQ(picture.depth(20, 0), INFINITY);
}

}  // namespace
}  // namespace bubblesim::test::test_camera
