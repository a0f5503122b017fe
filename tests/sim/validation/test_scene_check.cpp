// SPDX-License-Identifier: BSD-3-Clause
// Scenes built in code, so that every field can have any value.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "bubblesim/error.hpp"
#include "bubblesim/world.hpp"
#include "scenes.hpp"
#include "validation/scene_check.hpp"

namespace bubblesim::test::test_scene_check {
namespace {

/// A valid scene with one object of each kind.
SceneDescription fine() {
  SceneDescription all = jointed(joint("revolute", {axis(Vector3::UnitZ())}));
  ModelDescription& robot = all.models[0];
  for (const Geometry& geometry : {Geometry(Box{{1, 1, 1}}), Geometry(Sphere{1}), Geometry(Cylinder{1, 1})}) {
    robot.links[0].collisions.push_back(shape(geometry));
  }
  SensorDescription sonar;
  sonar.name = "Sonar";
  sonar.kind = SonarDescription{0.1, 2, 0.2};
  robot.links[0].sensors.push_back(sonar);
  robot.links.push_back(link("wheel"));
  robot.joints.push_back(joint("revolute2", {axis(Vector3::UnitZ()), axis(Vector3::UnitY())}, {}, "base", "wheel"));
  robot.joints[1].name = "steering";
  robot.source = {"robot.sdf", 7};
  all.models.push_back(floor());
  return all;
}

LinkDescription& base(SceneDescription& scene) { return scene.models[0].links[0]; }
AxisDescription& first_axis(SceneDescription& scene) { return scene.models[0].joints[0].axes[0]; }
SonarDescription& cone(SceneDescription& scene) { return base(scene).sensors[0].kind.get<SonarDescription>(); }

TEST(SceneCheck, FindsNothingInAFineScene) { EXPECT_TRUE(check_scene(fine()).empty()); }

/// A field, the path of its object, its name in messages, and invalid values besides NaN.
struct Field {
  const char* object;
  const char* called;
  std::function<double&(SceneDescription&)> of;
  std::vector<double> bad;
};

const double kNever = kInfinity;
std::vector<Field> fields() {
  return {
      {"", "gravity", [](auto& s) -> double& { return s.gravity[0]; }, {kNever, -kNever, 1e300}},
      {"", "gravity", [](auto& s) -> double& { return s.gravity[2]; }, {kNever}},
      {"", "time step", [](auto& s) -> double& { return s.time_step; }, {0, -1, 0.012, kNever, 1e300, 1e-300}},
      {"", "physics substep", [](auto& s) -> double& { return s.substep; }, {0, -1, kNever, 1e300, 1e-300}},
      {"/Robot", "position", [](auto& s) -> double& { return s.models[0].pose.position[1]; }, {kNever, -1e300}},
      {"/Robot/base", "position", [](auto& s) -> double& { return base(s).pose.position[0]; }, {kNever, 1e300}},
      {"/Robot/base", "mass", [](auto& s) -> double& { return base(s).mass; }, {0, -1, kNever, 1e300}},
      {"/Robot/base", "centre of mass", [](auto& s) -> double& { return base(s).centre_of_mass[0]; }, {kNever, 1e300}},
      {"/Robot/base",
       "inertia",
       [](auto& s) -> double& { return base(s).inertia_diagonal[0]; },
       {0, -1, kNever, 1e300}},
      {"/Robot/base", "inertia", [](auto& s) -> double& { return base(s).inertia_diagonal[1]; }, {0, -1, kNever}},
      {"/Robot/base", "inertia", [](auto& s) -> double& { return base(s).inertia_diagonal[2]; }, {0, -1, kNever}},
      {"/Robot/base", "inertia", [](auto& s) -> double& { return base(s).inertia_products[0]; }, {1.5, -1.5, kNever}},
      {"/Robot/base", "inertia", [](auto& s) -> double& { return base(s).inertia_products[1]; }, {1.5, 1e300}},
      {"/Robot/base", "inertia", [](auto& s) -> double& { return base(s).inertia_products[2]; }, {1.5, -kNever}},
      {"/Robot/base/shape",
       "position",
       [](auto& s) -> double& { return base(s).collisions[0].pose.position[2]; },
       {1e300}},
      {"/Robot/base/shape", "mu", [](auto& s) -> double& { return base(s).collisions[0].surface.mu; }, {-1, -kNever}},
      {"/Robot/base/shape",
       "x size",
       [](auto& s) -> double& { return std::get<Box>(base(s).collisions[0].geometry).size[0]; },
       {0, -1, kNever, 1e300}},
      {"/Robot/base/shape",
       "y size",
       [](auto& s) -> double& { return std::get<Box>(base(s).collisions[0].geometry).size[1]; },
       {0, -1, kNever}},
      {"/Robot/base/shape",
       "z size",
       [](auto& s) -> double& { return std::get<Box>(base(s).collisions[0].geometry).size[2]; },
       {0, -1, kNever}},
      {"/Robot/base/shape",
       "sphere's radius",
       [](auto& s) -> double& { return std::get<Sphere>(base(s).collisions[1].geometry).radius; },
       {0, -1, kNever, 1e300}},
      {"/Robot/base/shape",
       "cylinder's radius",
       [](auto& s) -> double& { return std::get<Cylinder>(base(s).collisions[2].geometry).radius; },
       {0, -1, kNever}},
      {"/Robot/base/shape",
       "cylinder's length",
       [](auto& s) -> double& { return std::get<Cylinder>(base(s).collisions[2].geometry).length; },
       {0, -1, kNever}},
      {"/Floor/link/shape",
       "plane's normal",
       [](auto& s) -> double& { return std::get<Plane>(s.models[1].links[0].collisions[0].geometry).normal[2]; },
       {0, kNever, 1e300}},
      {"/Robot/base/Sonar",
       "position",
       [](auto& s) -> double& { return base(s).sensors[0].pose.position[0]; },
       {kNever}},
      {"/Robot/base/Sonar",
       "update rate",
       [](auto& s) -> double& { return base(s).sensors[0].update_rate; },
       {-1, kNever, 1e300}},
      {"/Robot/base/Sonar", "minimum range", [](auto& s) -> double& { return cone(s).min_range; }, {-1, 2, kNever}},
      {"/Robot/base/Sonar", "maximum range", [](auto& s) -> double& { return cone(s).max_range; }, {0, -1, kNever}},
      {"/Robot/base/Sonar", "half angle", [](auto& s) -> double& { return cone(s).half_angle; }, {-1, 1.6, kNever}},
      {"/Robot/joint", "position", [](auto& s) -> double& { return s.models[0].joints[0].pose.position[0]; }, {1e300}},
      {"/Robot/joint", "axis", [](auto& s) -> double& { return first_axis(s).direction[2]; }, {0, 0.5, kNever, 1e300}},
      {"/Robot/joint", "limit", [](auto& s) -> double& { return first_axis(s).lower; }, {kNever, 1e300, -1e300}},
      {"/Robot/joint", "limit", [](auto& s) -> double& { return first_axis(s).upper; }, {-kNever, 1e300}},
      {"/Robot/joint", "effort", [](auto& s) -> double& { return first_axis(s).max_force; }, {-1, -kNever}},
      {"/Robot/joint", "velocity limit", [](auto& s) -> double& { return first_axis(s).max_velocity; }, {0, -1}},
      {"/Robot/joint", "friction", [](auto& s) -> double& { return first_axis(s).friction; }, {-1, kNever, 1e300}},
      {"/Robot/joint", "damping", [](auto& s) -> double& { return first_axis(s).damping; }, {-1, kNever, 1e300}},
  };
}

bool reports(const std::vector<Problem>& problems, const std::string& object, const std::string& text) {
  return std::any_of(problems.begin(), problems.end(), [&](const Problem& problem) {
    return problem.object == object && problem.message.find(text) != std::string::npos;
  });
}

TEST(SceneCheck, NoFieldTakesANumberThatPhysicsCannotTake) {
  for (Field& field : fields()) {
    field.bad.push_back(kNaN);
    for (const double bad : field.bad) {
      SceneDescription scene = fine();
      field.of(scene) = bad;
      EXPECT_TRUE(reports(check_scene(scene), field.object, field.called))
          << field.object << " " << field.called << " = " << bad;
      EXPECT_THROW(World(scene, 0), SceneError) << "the world rejects it, too";
    }
  }
}

TEST(SceneCheck, AllProblemsAreReportedAtOnce) {
  SceneDescription scene = fine();
  for (Field& field : fields()) field.of(scene) = kNaN;
  const std::vector<Problem> problems = check_scene(scene);
  for (const Field& field : fields()) {
    EXPECT_TRUE(reports(problems, field.object, field.called)) << field.object << " " << field.called;
  }
}

TEST(SceneCheck, ZeroQuaternionsAreNoRotations) {
  const std::vector<std::function<Pose&(SceneDescription&)>> poses = {
      [](auto& s) -> Pose& { return s.models[0].pose; },
      [](auto& s) -> Pose& { return base(s).pose; },
      [](auto& s) -> Pose& { return base(s).collisions[0].pose; },
      [](auto& s) -> Pose& { return base(s).sensors[0].pose; },
      [](auto& s) -> Pose& { return s.models[0].joints[0].pose; },
  };
  for (const auto& pose : poses) {
    for (const Quaternion& bad : {Quaternion(0, 0, 0, 0), Quaternion(kNaN, 0, 0, 0), Quaternion(3, 0, 0, 0)}) {
      SceneDescription scene = fine();
      pose(scene).orientation = bad;
      const std::vector<Problem> problems = check_scene(scene);
      ASSERT_EQ(problems.size(), 1u);
      EXPECT_NE(problems[0].message.find("the orientation"), std::string::npos);
    }
  }
}

TEST(SceneCheck, ProblemsOfAModelCarryItsSource) {
  SceneDescription scene = fine();
  scene.models[0].links.clear();
  scene.models[0].joints.clear();
  const std::vector<Problem> problems = check_scene(scene);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].text(), "robot.sdf:7: /Robot: has no link; add a <link>");
}

/// The problems of the valid scene after a change.
std::string problem_after(const std::function<void(ModelDescription&)>& change) {
  SceneDescription scene = fine();
  change(scene.models[0]);
  std::string all;
  for (const Problem& problem : check_scene(scene)) all += problem.object + ": " + problem.message + "\n";
  return all;
}

TEST(SceneCheck, NamesOfLinksAndJointsAreUsedOnce) {
  EXPECT_EQ(problem_after([](auto& robot) { robot.joints[0].name = "base"; }),
            "/Robot/base: the name 'base' is used twice in this model\n");
}

TEST(SceneCheck, LinksOfJointsExist) {
  EXPECT_EQ(problem_after([](auto& robot) { robot.joints[0].child = "wheal"; }),
            "/Robot/joint: the child 'wheal' is not a link of this model; did you mean wheel?\n");
  EXPECT_EQ(problem_after([](auto& robot) { robot.joints[0].parent = "bass"; }),
            "/Robot/joint: the parent 'bass' is not a link of this model; did you mean base?\n");
  EXPECT_EQ(problem_after([](auto& robot) { robot.canonical_link = "arms"; }),
            "/Robot: the canonical link 'arms' is not a link of this model; did you mean arm?\n");
  EXPECT_NE(problem_after([](auto& robot) { robot.joints[0].child = "world"; }), "");
}

TEST(SceneCheck, JointsConnectTwoLinks) {
  EXPECT_EQ(problem_after([](auto& robot) { robot.joints[0].parent = "arm"; }),
            "/Robot/joint: connects the link 'arm' with itself\n");
}

TEST(SceneCheck, UnknownJointTypesNameTheKnownOnes) {
  EXPECT_EQ(problem_after([](auto& robot) { robot.joints[0].type = "rope"; }),
            "/Robot/joint: joint type 'rope' is not supported; supported types: revolute, continuous, prismatic, "
            "fixed, ball, revolute2, universal, screw, gearbox\n");
}

TEST(SceneCheck, JointsHaveAsManyAxesAsTheirTypeNeeds) {
  EXPECT_NE(problem_after([](auto& robot) { robot.joints[0].axes.clear(); }).find("the number of axes is 0"),
            std::string::npos);
  EXPECT_NE(problem_after([](auto& robot) { robot.joints[1].axes.pop_back(); }).find("it must be 2 for a revolute2"),
            std::string::npos);
}

TEST(SceneCheck, Revolute2IsWhatPhysicsCanDo) {
  EXPECT_NE(
      problem_after([](auto& robot) { robot.joints[1].axes[1].direction = -Vector3::UnitZ(); }).find("not parallel"),
      std::string::npos);
  EXPECT_NE(problem_after([](auto& robot) { robot.joints[1].parent = "world"; }).find("not the world"),
            std::string::npos);
  EXPECT_NE(problem_after([](auto& robot) { robot.joints[1].axes[1].upper = 1; }).find("cannot have limits"),
            std::string::npos);
}

TEST(SceneCheck, PlanesDoNotMove) {
  EXPECT_NE(problem_after([](auto& robot) { robot.links[0].collisions[0].geometry = Plane{}; }).find("cannot move"),
            std::string::npos);
}

TEST(SceneCheck, StaticModelsNeedNoMass) {
  SceneDescription scene = fine();
  scene.models[1].links[0].mass = 0;
  scene.models[1].links[0].inertia_diagonal = Vector3::Zero();
  EXPECT_TRUE(check_scene(scene).empty());
}

}  // namespace
}  // namespace bubblesim::test::test_scene_check
