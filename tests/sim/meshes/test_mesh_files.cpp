// SPDX-License-Identifier: BSD-3-Clause
// Meshes from files.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <iterator>

#include "meshes.hpp"
#include "meshes/mesh_file.hpp"
#include "near.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_mesh_files {
namespace {

std::shared_ptr<const TriangleMesh> load(const MeshRequest& request) {
  MeshReader reader;
  return load_mesh(request, reader);
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
  expect_near(mesh->low, {0, 0, 0}, kMeshRounding);
  expect_near(mesh->high, {1, 1, 1}, kMeshRounding);
}

TEST(MeshFile, IsScaledAlongItsAxes) {
  const TemporaryFile file("corner.stl", kStl);
  expect_near(load({file.path(), {2, 3, 4}})->high, {2, 3, 4}, kMeshRounding);
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
  expect_near(load({file.path(), Vector3::Ones(), "large"})->low, {10, 0, 0}, kMeshRounding);
}

TEST(MeshFile, CentersASubmeshIfAsked) {
  const TemporaryFile file("parts.obj", kObj);
  const auto mesh = load({file.path(), Vector3::Ones(), "large", true});
  expect_near(mesh->low, {-1, -2, 0}, kMeshRounding);
  expect_near(mesh->high, {1, 2, 0}, kMeshRounding);
}

TEST(MeshFile, WithoutTheSubmeshAskedForNamesASimilarOne) {
  const TemporaryFile file("parts.obj", kObj);
  EXPECT_EQ(mesh_problem([&] {
              load({file.path(), Vector3::Ones(), "lage"});
            }),
            "has no submesh 'lage'; did you mean large?");
}

TEST(MeshFile, OfColladaIsInMetersWithItsAxesAsTheyAre) {
  const TemporaryFile file("tri.dae", kDae);
  const auto mesh = load({file.path()});
  expect_near(mesh->low, {0.254, 0, 0}, kMeshRounding);
  expect_near(mesh->high, {0.2794, 0, 0.0254}, kMeshRounding);
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
  expect_near(mesh->low, {0.254, 0, 0}, kMeshRounding);
  expect_near(mesh->high, {0.2794, 0, 0.0254}, kMeshRounding);
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

TEST(MeshFile, ThatCannotBeReadStatesWhy) {
  const TemporaryFile broken("broken.dae", "<COLLADA");
  EXPECT_NE(mesh_problem([&] { load({broken.path()}); }).find("cannot be read as a mesh"), std::string::npos);
  const TemporaryFile empty("empty.stl", "solid nothing\nendsolid nothing\n");
  EXPECT_NE(mesh_problem([&] { load({empty.path()}); }), "");
  EXPECT_EQ(mesh_problem([&] { load({"/nowhere/at_all.stl"}); }), "does not exist");
}

std::size_t number_of_children() {
  std::ifstream children("/proc/thread-self/children");
  return static_cast<std::size_t>(std::distance(std::istream_iterator<int>(children), {}));
}

TEST(MeshFile, ThatIsDamagedIsReadOnce) {
  const TemporaryFile broken("broken.dae", "<COLLADA version='1.4.1'>");
  const std::string reported = mesh_problem([&] { load({broken.path()}); });
  const std::size_t before = number_of_children();
  MeshReader reader;
  EXPECT_EQ(mesh_problem([&] { load_mesh({broken.path()}, reader); }), reported);
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
    const std::string reported = mesh_problem([&] { load_mesh({file}, reader); });
    EXPECT_EQ(reported.find("cannot be read as a mesh"), 0U) << reported;
    EXPECT_EQ(load_mesh({fine.path()}, reader)->triangles.size(), 4U);
  }
}

TEST(MeshFile, OfWhichPartsAreTakenIsReadForEach) {
  const TemporaryFile file("two.obj", kObj);
  MeshReader reader;
  for (int i = 0; i < 2; ++i) {
    expect_near(load_mesh({file.path(), Vector3::Ones(), "large"}, reader)->low, {10, 0, 0}, kMeshRounding);
    expect_near(load_mesh({file.path(), Vector3::Ones(), "small"}, reader)->high, {1, 1, 0}, kMeshRounding);
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
  expect_near(load({file.path()})->high, {2, 1, 1}, kMeshRounding);
}

TEST(MeshFile, ThatIsAFifoIsAnError) {
  const TemporaryFile beside("corner.stl", kStl);
  const std::string fifo = beside.folder() + "/fifo.stl";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(mesh_problem([&] { load({fifo}); }), "is not a regular file");
}

}  // namespace
}  // namespace bubblesim::test::test_mesh_files
