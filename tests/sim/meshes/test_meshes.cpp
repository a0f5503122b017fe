// SPDX-License-Identifier: BSD-3-Clause
// Meshes from files, outlines and images.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>

#include "meshes/convex_hull.hpp"
#include "meshes/made_meshes.hpp"
#include "meshes/mesh_error.hpp"
#include "meshes/mesh_file.hpp"
#include "near.hpp"
#include "scene_files.hpp"
#include "surfaces.hpp"

namespace bubblesim::test::test_meshes {
namespace {

using Point2 = Eigen::Vector2d;

constexpr double kRounding = 1e-6;  // m, of single precision

double volume(const TriangleMesh& mesh) {
  return enclosed_volume(mesh.triangles, [&](std::uint32_t i) {
    const TriangleMesh::Point& place = mesh.vertices[i];
    return Vector3(place[0], place[1], place[2]);
  });
}

Vector3 size(const TriangleMesh& mesh) { return mesh.high - mesh.low; }

std::shared_ptr<const TriangleMesh> load(const MeshRequest& request) {
  MeshReader reader;
  return load_mesh(request, reader);
}

template <class Call>
std::string problem(const Call& call) {
  try {
    call();
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

// A tetrahedron with corners at the origin and at 1 on each axis: a sixth of a cubic metre.
const char* const kStl = R"(solid corner
facet normal 0 0 -1
outer loop
vertex 0 0 0
vertex 0 1 0
vertex 1 0 0
endloop
endfacet
facet normal 0 -1 0
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 0 1
endloop
endfacet
facet normal -1 0 0
outer loop
vertex 0 0 0
vertex 0 0 1
vertex 0 1 0
endloop
endfacet
facet normal 1 1 1
outer loop
vertex 1 0 0
vertex 0 1 0
vertex 0 0 1
endloop
endfacet
endsolid corner
)";

const char* const kObj = R"(mtllib colors.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 10 0 0
v 12 0 0
v 10 4 0
vn 0 0 1
o small
usemtl red
f 1//1 2//1 3//1
o large
usemtl blue
f 4//1 5//1 6//1
)";

/// One triangle in the xz plane, in inches, moved by its node; the file declares y up, which is ignored.
const char* const kDae = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="0.0254" name="inch"/><up_axis>Y_UP</up_axis></asset>
<library_effects><effect id="paint-effect"><profile_COMMON><technique sid="common"><lambert>
<diffuse><color>0.2 0.4 0.6 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="paint"><instance_effect url="#paint-effect"/></material></library_materials>
<library_geometries><geometry id="tri-id" name="tri"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 0 1</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles material="m" count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="node-id" name="Part">
<matrix>1 0 0 10 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
<instance_geometry url="#tri-id"><bind_material><technique_common><instance_material symbol="m" target="#paint"/>
</technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";

TEST(MeshFile, OfStlIsFlatAndWoundOutwards) {
  const TemporaryFile file("corner.stl", kStl);
  const auto mesh = load({file.path()});
  EXPECT_EQ(mesh->triangles.size(), 4U);
  EXPECT_TRUE(mesh->normals.empty());
  EXPECT_NEAR(volume(*mesh), 1.0 / 6, 1e-6);
  expect_near(mesh->low, {0, 0, 0}, kRounding);
  expect_near(mesh->high, {1, 1, 1}, kRounding);
}

TEST(MeshFile, IsScaledAlongItsAxes) {
  const TemporaryFile file("corner.stl", kStl);
  expect_near(load({file.path(), {2, 3, 4}})->high, {2, 3, 4}, kRounding);
}

TEST(MeshFile, MirroredByItsScaleStaysWoundOutwards) {
  const TemporaryFile file("corner.stl", kStl);
  EXPECT_NEAR(volume(*load({file.path(), {-1, 1, 1}})), 1.0 / 6, 1e-6);
}

TEST(MeshFile, OfObjHasTheColorsOfItsMaterials) {
  const TemporaryFile materials("colors.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  const TemporaryFile file("parts.obj", kObj);
  const auto mesh = load({file.path()});
  ASSERT_EQ(mesh->material_of.size(), 2U);
  EXPECT_EQ(mesh->materials[mesh->material_of[0]].diffuse.r, 1);
  EXPECT_EQ(mesh->materials[mesh->material_of[1]].diffuse.b, 1);
}

TEST(MeshFile, GivesASubmeshByName) {
  const TemporaryFile file("parts.obj", kObj);
  expect_near(load({file.path(), Vector3::Ones(), "large"})->low, {10, 0, 0}, kRounding);
}

TEST(MeshFile, CentersASubmeshIfAsked) {
  const TemporaryFile file("parts.obj", kObj);
  const auto mesh = load({file.path(), Vector3::Ones(), "large", true});
  expect_near(mesh->low, {-1, -2, 0}, kRounding);
  expect_near(mesh->high, {1, 2, 0}, kRounding);
}

TEST(MeshFile, WithoutTheSubmeshAskedForTellsASimilarOne) {
  const TemporaryFile file("parts.obj", kObj);
  EXPECT_EQ(problem([&] {
              load({file.path(), Vector3::Ones(), "lage"});
            }),
            "has no submesh 'lage'; did you mean large?");
}

TEST(MeshFile, OfColladaIsInMetersWithItsAxesAsTheyAre) {
  const TemporaryFile file("tri.dae", kDae);
  const auto mesh = load({file.path()});
  expect_near(mesh->low, {0.254, 0, 0}, kRounding);
  expect_near(mesh->high, {0.2794, 0, 0.0254}, kRounding);
  ASSERT_EQ(mesh->materials.size(), 1U);
  EXPECT_FLOAT_EQ(mesh->materials[0].diffuse.g, 0.4F);
}

TEST(MeshFile, OfColladaMayHaveCommentsAndSpacesAnywhere) {
  std::string spaced = kDae;
  const auto replace = [&spaced](const std::string& from, const std::string& to) {
    spaced.replace(spaced.find(from), from.size(), to);
  };
  replace(R"(<vertices id="v">)", R"(<vertices id="v"><!-- <vertices id="old"> -->)");
  replace("<color>0.2", "<color>\n  0.2");
  replace("<matrix>1", "<matrix> <!-- row by row -->\n\t1");
  replace("<p>0 1 2</p>", "<p> 0 1  2 </p>");
  replace(">0 0 0 1 0", ">\n0 0 0\t1 0");
  const TemporaryFile file("spaced.dae", spaced);
  const auto mesh = load({file.path()});
  expect_near(mesh->low, {0.254, 0, 0}, kRounding);
  expect_near(mesh->high, {0.2794, 0, 0.0254}, kRounding);
  EXPECT_FLOAT_EQ(mesh->materials.at(0).diffuse.g, 0.4F);
}

TEST(MeshFile, OfColladaKnowsASubmeshByTheNameAndTheIdOfItsNodeAndGeometry) {
  const TemporaryFile file("tri.dae", kDae);
  for (const char* name : {"Part", "node-id", "tri", "tri-id"}) {
    EXPECT_EQ(load({file.path(), Vector3::Ones(), name})->triangles.size(), 1U) << name;
  }
}

TEST(MeshFile, IsReadOnceAndSharedWhileAnybodyUsesIt) {
  const TemporaryFile file("corner.stl", kStl);
  const auto mesh = load({file.path()});
  EXPECT_EQ(load({file.path()}), mesh);
  EXPECT_NE(load({file.path(), {1, 1, 2}}), mesh);
}

TEST(MeshFile, ThatCannotBeReadTellsWhy) {
  const TemporaryFile broken("broken.dae", "<COLLADA");
  EXPECT_NE(problem([&] { load({broken.path()}); }).find("cannot be read as a mesh"), std::string::npos);
  const TemporaryFile empty("empty.stl", "solid nothing\nendsolid nothing\n");
  EXPECT_NE(problem([&] { load({empty.path()}); }), "");
  EXPECT_EQ(problem([&] { load({"/nowhere/at_all.stl"}); }), "does not exist");
}

std::size_t number_of_children() {
  std::ifstream children("/proc/thread-self/children");
  return static_cast<std::size_t>(std::distance(std::istream_iterator<int>(children), {}));
}

TEST(MeshFile, ThatIsDamagedIsReadOnce) {
  const TemporaryFile broken("broken.dae", "<COLLADA version='1.4.1'>");
  const std::string reported = problem([&] { load({broken.path()}); });
  const std::size_t before = number_of_children();
  MeshReader reader;
  EXPECT_EQ(problem([&] { load_mesh({broken.path()}, reader); }), reported);
  EXPECT_EQ(number_of_children(), before) << "a reader was started";
}

// Their effect in assimp: an invalid token takes memory without end, and the nodes overflow its stack.
TEST(MeshFile, ThatItsReaderDoesNotSurviveIsAnErrorAndTheNextOneIsRead) {
  std::string endless = kDae;
  endless.replace(endless.find("<p>0 1 2</p>"), 12, "<p>0 x 2</p>");
  const TemporaryFile runs_away("endless.dae", endless);
  std::string deep = kDae;
  const std::size_t node = deep.find("<node ");
  for (const auto& [place, text] : {std::pair(deep.find("</visual_scene>"), "</node>"), std::pair(node, "<node>")}) {
    std::string nodes;
    for (int i = 0; i < 200'000; ++i) nodes += text;
    deep.insert(place, nodes);
  }
  const TemporaryFile crashes("deep.dae", deep);
  const TemporaryFile fine("corner.stl", kStl);
  MeshReader reader;
  for (const std::string& file : {runs_away.path(), crashes.path()}) {
    const std::string reported = problem([&] { load_mesh({file}, reader); });
    EXPECT_EQ(reported.find("cannot be read as a mesh"), 0U) << reported;
    EXPECT_EQ(load_mesh({fine.path()}, reader)->triangles.size(), 4U);
  }
}

TEST(MeshFile, OfWhichPartsAreTakenIsReadForEach) {
  const TemporaryFile file("two.obj", kObj);
  MeshReader reader;
  for (int i = 0; i < 2; ++i) {
    expect_near(load_mesh({file.path(), Vector3::Ones(), "large"}, reader)->low, {10, 0, 0}, kRounding);
    expect_near(load_mesh({file.path(), Vector3::Ones(), "small"}, reader)->high, {1, 1, 0}, kRounding);
  }
}

TEST(MeshFile, IsKnownByItsContent) {
  const TemporaryFile file("corner.stl", kStl);
  const auto mesh = load({file.path()});
  fs::last_write_time(file.path(), fs::last_write_time(file.path()) + std::chrono::hours(1));
  EXPECT_EQ(load({file.path()}), mesh);
  const auto time = fs::last_write_time(file.path());
  std::string wider = kStl;
  for (std::size_t at = 0; (at = wider.find("vertex 1", at)) != std::string::npos; ++at) wider[at + 7] = '2';
  std::ofstream(file.path()) << wider;
  fs::last_write_time(file.path(), time);
  expect_near(load({file.path()})->high, {2, 1, 1}, kRounding);
}

TEST(MeshFile, ThatIsAFifoIsAnError) {
  const TemporaryFile beside("corner.stl", kStl);
  const std::string fifo = beside.folder() + "/fifo.stl";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(problem([&] { load({fifo}); }), "is not a regular file");
}

TEST(Surface, LosesTrianglesWithoutAnArea) {
  TriangleMesh mesh = box_triangles({1, 1, 1});
  mesh.triangles.push_back({0, 0, 1});
  EXPECT_EQ(finish_mesh(mesh)->triangles.size(), 12U);
}

TEST(Surface, WithNumbersThatAreNoneIsTurnedDown) {
  TriangleMesh mesh = box_triangles({1, 1, 1});
  mesh.vertices[3][1] = NAN;
  EXPECT_NE(problem([&] { finish_mesh(mesh); }).find("not finite"), std::string::npos);
  mesh = box_triangles({1, 1, 1});
  mesh.triangles[3][1] = 8;
  EXPECT_NE(problem([&] { finish_mesh(mesh); }).find("does not exist"), std::string::npos);
  mesh.triangles.clear();
  EXPECT_NE(problem([&] { finish_mesh(mesh); }).find("no triangle"), std::string::npos);
}

class Extrusion : public ::testing::TestWithParam<bool> {};

TEST_P(Extrusion, OfAConcaveOutlineEnclosesItsAreaTimesItsHeight) {
  // An L: three unit squares.
  std::vector<Point2> outline = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  if (GetParam()) std::reverse(outline.begin(), outline.end());
  const auto mesh = extrude({{outline, 0.5}});
  EXPECT_NEAR(volume(*mesh), 1.5, 1e-6);
  expect_near(size(*mesh), {2, 2, 0.5}, kRounding);
}

INSTANTIATE_TEST_SUITE_P(EitherWayRound, Extrusion, ::testing::Bool());

TEST(Extrusions, TakeAClosedOutlineAndCornersInOneLine) {
  EXPECT_NEAR(volume(*extrude({{{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}}, 1}})), 4, 1e-6);
}

TEST(Extrusions, TellWhatIsWrongWithAnOutline) {
  EXPECT_EQ(problem([] { extrude({{{{0, 0}, {1, 0}}, 1}}); }), "has fewer than three corners");
  EXPECT_EQ(problem([] { extrude({{{{0, 0}, {1, 0}, {2, 0}}, 1}}); }), "has no area");
  EXPECT_EQ(problem([] { extrude({{{{0, 0}, {1, 0}, {1, 1}}, 0}}); }), "must have a height above 0");
  EXPECT_EQ(problem([] { extrude({{{{0, 0}, {2, 2}, {2, 0}, {0, 3}}, 1}}); }), "crosses itself");
}

TEST(Extrusions, HaveHolesWhereOutlinesLieInOthers) {
  const auto square = [](double half, double x = 0) {
    return std::vector<Point2>{{x - half, -half}, {x + half, -half}, {x + half, half}, {x - half, half}};
  };
  // A frame with a pillar in it, two windows in a wall, and two squares that cross.
  EXPECT_NEAR(volume(*extrude({{square(3), 1}, {square(2), 1}, {square(1), 1}})), 36 - 16 + 4, 1e-5);
  EXPECT_NEAR(volume(*extrude({{square(1, -2), 1}, {square(4), 0.5}, {square(1, 2), 1}})), (64 - 4 - 4) * 0.5, 1e-5);
  EXPECT_NEAR(volume(*extrude({{square(1), 1}, {square(1, 1.5), 1}})), 8, 1e-5);
}

TEST(Walls, StandOnTheDarkPixelsOfAPicture) {
  // Three pixels in an L, of 3 x 2; the image's upper edge is at +y.
  const Heights picture{3, 2, {0, 1, 1, 0, 0.5F, 1}};
  const auto mesh = raise_walls(picture, 0.1, 200, 2);
  EXPECT_NEAR(volume(*mesh), 3 * 0.1 * 0.1 * 2, 1e-6);
  expect_near(mesh->low, {-0.15, -0.1, 0}, kRounding);
  expect_near(mesh->high, {0.05, 0.1, 2}, kRounding);
  EXPECT_EQ(problem([&] { raise_walls(picture, 0.1, 0, 1); }), "has no pixel darker than the <threshold>");
}

TEST(Ground, HasItsUpperEdgeAtPlusYAndItsBrightestPixelAtItsHeight) {
  const Heights heights{3, 2, {0.5F, 0, 0, 0, 0, 0}};
  const auto mesh = raise_ground(heights, {4, 2, 3}, {10, 0, 1});
  expect_near(mesh->low, {8, -1, 1}, kRounding);
  expect_near(mesh->high, {12, 1, 4}, kRounding);
  const auto top = std::find_if(mesh->vertices.begin(), mesh->vertices.end(),
                                [](const TriangleMesh::Point& point) { return point[2] > 3.9F; });
  ASSERT_NE(top, mesh->vertices.end());
  EXPECT_FLOAT_EQ((*top)[0], 8);
  EXPECT_FLOAT_EQ((*top)[1], 1);
}

TEST(Ground, OfALargePictureIsThinnedOutToItsEdges) {
  Heights heights{2000, 3, std::vector<float>(6000, 0.0F)};
  heights.values.back() = 1;
  const auto mesh = raise_ground(heights, {1, 1, 1});
  EXPECT_EQ(mesh->triangles.size(), 2U * 512 * 2);
  EXPECT_EQ(mesh->high.z(), 1);
}

TEST(Tessellation, IsWoundOutwardsAndNearlyFillsItsEllipsoid) {
  const auto mesh = tessellate(Ellipsoid{{1, 2, 3}});
  EXPECT_NEAR(volume(*mesh) / (4.0 / 3 * M_PI * 6), 1, 0.01);
}

TEST(ConvexHull, OfAFinelyDividedBoxHasItsEightCorners) {
  // Each face of the cube in 10 x 10 squares.
  TriangleMesh mesh;
  constexpr std::uint32_t kSide = 11;
  for (int face = 0; face < 6; ++face) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      TriangleMesh::Point point{};
      const auto axis = static_cast<std::size_t>(face / 2);
      point[axis] = face % 2 == 0 ? -0.5F : 0.5F;
      point[(axis + 1) % 3] = static_cast<float>(i % kSide) / 10 - 0.5F;
      point[(axis + 2) % 3] = static_cast<float>(i / kSide) / 10 - 0.5F;
      mesh.vertices.push_back(point);
    }
    for (std::uint32_t i = 0; i + kSide + 1 < kSide * kSide; ++i) {
      if (i % kSide == kSide - 1) continue;
      const std::uint32_t a = first + i;
      mesh.triangles.push_back({a, a + 1, a + kSide});
      mesh.triangles.push_back({a + 1, a + kSide + 1, a + kSide});
    }
  }
  const Hull hull = convex_hull(mesh);
  EXPECT_EQ(hull.corners.size(), 8U);
  EXPECT_NEAR(enclosed_volume(hull.triangles, [&](std::uint32_t i) { return hull.corners[i]; }), 1, 1e-6);
}

TEST(ConvexHull, OfAFlatSurfaceIsNothing) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  EXPECT_TRUE(convex_hull(mesh).triangles.empty());
}

}  // namespace
}  // namespace bubblesim::test::test_meshes
