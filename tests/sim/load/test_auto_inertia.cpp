// SPDX-License-Identifier: BSD-3-Clause
// <inertial auto="true">: against the formulas of solids, and what libsdformat documents.
#include <gtest/gtest.h>

#include <cmath>

#include "bubblesim/scene_loader.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_auto_inertia {
namespace {

LinkDescription link_of(const std::string& inertial, const std::string& collisions,
                        std::vector<Problem>* warnings = nullptr) {
  const TemporaryFile file("auto.sdf",
                           in_world("<model name='m'><link name='l'>" + inertial + collisions + "</link></model>"));
  return read_scene(file.path(), {}, warnings).models.at(0).links.at(0);
}

std::string shape(const std::string& geometry, const std::string& more = "") {
  return "<collision name='c'>" + more + "<geometry>" + geometry + "</geometry></collision>";
}

const std::string kAuto = "<inertial auto='true'/>";
const std::string kUnitBox = "<box><size>1 1 1</size></box>";

void expect_inertia(const LinkDescription& link, double mass, const Vector3& centre, const Vector3& moments,
                    const Vector3& products = Vector3(), double tolerance = 1e-9) {
  EXPECT_NEAR(link.mass, mass, tolerance * mass);
  EXPECT_TRUE(link.centre_of_mass.isApprox(centre, tolerance) || (link.centre_of_mass - centre).norm() < tolerance)
      << link.centre_of_mass.transpose();
  const double most = moments.maxCoeff();
  EXPECT_LT((link.inertia_diagonal - moments).norm(), tolerance * most) << link.inertia_diagonal.transpose();
  EXPECT_LT((link.inertia_products - products).norm(), tolerance * most) << link.inertia_products.transpose();
}

TEST(AutoInertia, IsThatOfTheSolid) {
  const double m = 1000 * 2 * 3 * 4;
  expect_inertia(link_of(kAuto, shape("<box><size>2 3 4</size></box>")), m, {},
                 m / 12 * Vector3(9 + 16, 4 + 16, 4 + 9));
  const double r = 0.5;
  const double ball = 1000 * 4 * M_PI / 3 * r * r * r;
  expect_inertia(link_of(kAuto, shape("<sphere><radius>0.5</radius></sphere>")), ball, {},
                 0.4 * ball * r * r * Vector3::Ones());
  const double l = 2;
  const double rod = 1000 * M_PI * r * r * l;
  expect_inertia(link_of(kAuto, shape("<cylinder><radius>0.5</radius><length>2</length></cylinder>")), rod, {},
                 rod * Vector3(r * r / 4 + l * l / 12, r * r / 4 + l * l / 12, r * r / 2));
  const double egg = 1000 * 4 * M_PI / 3 * 1 * 2 * 3;
  expect_inertia(link_of(kAuto, shape("<ellipsoid><radii>1 2 3</radii></ellipsoid>")), egg, {},
                 egg / 5 * Vector3(4 + 9, 1 + 9, 1 + 4));
  // The moments of a capsule: the barrel, and half balls with 83/320 m r^2 about their centroids, l/2 + 3r/8 away.
  const double arm = l / 2 + 3 * r / 8;
  const double across = rod * (r * r / 4 + l * l / 12) + ball * (83.0 / 320 * r * r + arm * arm);
  expect_inertia(link_of(kAuto, shape("<capsule><radius>0.5</radius><length>2</length></capsule>")), rod + ball, {},
                 {across, across, rod * r * r / 2 + 0.4 * ball * r * r});
  // A cone about its centroid, which is a quarter of its height above the base.
  const double cone = rod / 3;
  expect_inertia(link_of(kAuto, shape("<cone><radius>0.5</radius><length>2</length></cone>")), cone, {0, 0, -l / 4},
                 cone * Vector3(3 * r * r / 20 + 3 * l * l / 80, 3 * r * r / 20 + 3 * l * l / 80, 3 * r * r / 10));
}

TEST(AutoInertia, IsThatOfAMeshWhicheverWayItsTrianglesFace) {
  // A prism on a right triangle with the legs a and b: centroid a/3, b/3; moments about it m a^2/18, m b^2/18, product
  // of the coordinates -m a b/36.
  const double a = 0.3, b = 0.6, h = 0.5;
  const double m = 500 * a * b / 2 * h;
  const Vector3 moments(m * (b * b / 18 + h * h / 12), m * (a * a / 18 + h * h / 12), m * (a * a + b * b) / 18);
  for (const std::string points : {"<point>0 0</point><point>0.3 0</point><point>0 0.6</point>",
                                   "<point>0 0</point><point>0 0.6</point><point>0.3 0</point>"}) {
    const std::string prism = "<polyline><height>0.5</height>" + points + "</polyline>";
    expect_inertia(link_of(kAuto, shape(prism, "<density>500</density>")), m, {a / 3, b / 3, h / 2}, moments,
                   {m * a * b / 36, 0, 0}, 1e-6);
  }
  const TemporaryFile file("box.obj",
                           "v 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\n"
                           "f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n");  // inwards
  expect_inertia(link_of(kAuto, shape("<mesh><uri>" + file.path() + "</uri><scale>1 1 2</scale></mesh>")), 2000,
                 {1.5, 0.5, 1}, 2000 / 12.0 * Vector3(5, 5, 2), {}, 1e-6);
}

TEST(AutoInertia, AddsShapesWithTheirDensitiesAndPoses) {
  // Two boxes beside each other, the second one twice as dense: parallel axes.
  const double m1 = 1000, m2 = 2000, away = 3;
  const double reduced = m1 * m2 / (m1 + m2) * away * away;
  const double own = (m1 + m2) / 6;
  expect_inertia(
      link_of(kAuto, shape(kUnitBox) + "<collision name='d'><pose>3 0 0 0 0 0</pose><density>2000</density>" +
                         "<geometry>" + kUnitBox + "</geometry></collision>"),
      m1 + m2, {2, 0, 0}, {own, own + reduced, own + reduced});
  // A bar that is turned by 30 degrees about z: I = R diag(Ix, Iy, Iz) R^T.
  const double m = 4000, angle = M_PI / 6;
  const Vector3 bar = m / 12 * Vector3(2, 17, 17);
  const double c = std::cos(angle), s = std::sin(angle);
  expect_inertia(link_of(kAuto, shape("<box><size>4 1 1</size></box>", "<pose degrees='true'>0 0 1 0 0 30</pose>")), m,
                 {0, 0, 1}, {c * c * bar.x() + s * s * bar.y(), s * s * bar.x() + c * c * bar.y(), bar.z()},
                 {c * s * (bar.x() - bar.y()), 0, 0});
}

TEST(AutoInertia, TakesTheDensityOfTheCollisionBeforeThatOfTheLink) {
  const std::string dense = "<inertial auto='true'><density>12</density></inertial>";
  EXPECT_NEAR(link_of(dense, shape(kUnitBox)).mass, 12, 1e-9);
  EXPECT_NEAR(link_of(dense, shape(kUnitBox, "<density>24</density>")).mass, 24, 1e-9);
  EXPECT_NEAR(link_of(kAuto, shape(kUnitBox)).mass, 1000, 1e-9);
}

TEST(AutoInertia, IsScaledToTheMassAndIgnoresPoseAndInertia) {
  expect_inertia(link_of("<inertial auto='true'><mass>4</mass><pose>1 1 1 2 2 2</pose><inertia><ixx>1</ixx><iyy>1</iyy>"
                         "<izz>1</izz></inertia></inertial>",
                         shape(kUnitBox, "<density>2</density>")),
                 4, {}, 4.0 / 6 * Vector3::Ones());
  const std::string off = "<inertial auto='false'><mass>4</mass></inertial>";
  expect_inertia(link_of(off, shape(kUnitBox)), 4, {}, Vector3::Ones());
}

TEST(AutoInertia, StatesWhatHasNoMass) {
  const auto problem = [](const std::string& inertial, const std::string& collisions) {
    try {
      link_of(inertial, collisions);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(problem(kAuto, "").find("has no collision shape with a volume; add a <collision>"), std::string::npos);
  EXPECT_NE(problem(kAuto, shape(kUnitBox, "<density>0</density>")).find("/m/l/c: <density> is 0 kg/m^3"),
            std::string::npos);
  const TemporaryFile file("lid.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");  // a hole
  std::vector<Problem> warnings;
  const std::string lid = shape("<mesh><uri>" + file.path() + "</uri></mesh>");
  const std::string box = "<collision name='d'><geometry>" + kUnitBox + "</geometry></collision>";
  EXPECT_NEAR(link_of(kAuto, lid + box, &warnings).mass, 1000, 1e-9);
  EXPECT_NE(lines_of(warnings).find("is not closed, it adds no mass"), std::string::npos) << lines_of(warnings);
}

}  // namespace
}  // namespace bubblesim::test::test_auto_inertia
