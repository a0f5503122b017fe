// SPDX-License-Identifier: BSD-3-Clause
// The files of a scene: meshes, images and material scripts by URI; URDF, xacro and old scenes.
#include <gtest/gtest.h>

#include <cstdlib>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/triangle_mesh.hpp"
#include "bubblesim/world.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_scene_files {
namespace {

const char* const kStl =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid "
    "s\n";

class SceneFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("bubblesim_scene_files_" + std::to_string(::getpid()));
    for (const char* variable : {"ROS_PACKAGE_PATH", "CMAKE_PREFIX_PATH", "GAZEBO_MODEL_PATH"}) ::unsetenv(variable);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
    return (folder_ / file).string();
  }

  static std::string model_with(const std::string& shape) {
    return "<sdf version='1.6'><model name='m'><link name='l'>" + shape + "</link></model></sdf>";
  }

  static std::string mesh(const std::string& uri, const std::string& role = "collision") {
    return "<" + role + " name='s'><geometry><mesh><uri>" + uri + "</uri></mesh></geometry></" + role + ">";
  }

  static std::string reported_for(const std::string& file) {
    try {
      read_scene(file);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(SceneFiles, OfAMeshAreFoundByEachKindOfUri) {
  write("ws/robots/package.xml", "<package><name>my_robot</name></package>");
  write("ws/robots/meshes/a.stl", kStl);
  write("models/thing/meshes/a.stl", kStl);
  ::setenv("ROS_PACKAGE_PATH", ("/nowhere:" + (folder_ / "ws").string()).c_str(), 1);
  ::setenv("GAZEBO_MODEL_PATH", (folder_ / "models").c_str(), 1);
  for (const std::string& uri :
       {std::string("package://my_robot/meshes/a.stl"), std::string("model://thing/meshes/a.stl"),
        "file://" + (folder_ / "models/thing/meshes/a.stl").string(), std::string("../models/thing/meshes/a.stl")}) {
    const SceneDescription scene = read_scene(write("scene/s.sdf", model_with(mesh(uri))));
    const auto& geometry = scene.models.at(1).links.at(0).collisions.at(0).geometry;
    EXPECT_EQ(std::get<Mesh>(geometry).triangles->triangles.size(), 1U) << uri;
  }
}

TEST_F(SceneFiles, OfAPackageAreFoundAsThoseOfAModel) {
  write("models/thing/meshes/a.stl", kStl);
  ::setenv("GAZEBO_MODEL_PATH", (folder_ / "models").c_str(), 1);
  for (const std::string uri : {"package://thing/meshes/a.stl", "package:///thing/meshes/a.stl"}) {
    const SceneDescription scene = read_scene(write("scene/s.sdf", model_with(mesh(uri))));
    EXPECT_EQ(scene.models.at(1).links.at(0).collisions.size(), 1U) << uri;
  }
}

TEST_F(SceneFiles, OfAModelAreFoundBesideItWhateverItsFolderIsCalled) {
  write("copy_of_thing/meshes/a.stl", kStl);
  read_scene(write("copy_of_thing/model.sdf", model_with(mesh("model://thing/meshes/a.stl"))));
  write("around/meshes/a.stl", kStl);
  read_scene(write("around/model.sdf", model_with(mesh("model://around/meshes/a.stl"))));
}

TEST_F(SceneFiles, OfAPackageAreFoundFromWithinIt) {
  write("pkg/package.xml", "<package><name>my_robot</name></package>");
  write("pkg/meshes/a.stl", kStl);
  read_scene(write("pkg/urdf/deep/model.sdf", model_with(mesh("package://my_robot/meshes/a.stl"))));
}

TEST_F(SceneFiles, BrokenMeshIsAnErrorOfACollisionAndAWarningOfAVisual) {
  write("a.stl", "this is no mesh");
  const std::string reported = reported_for(write("s.sdf", model_with(mesh("a.stl"))));
  EXPECT_NE(reported.find("s.sdf:1: /m/l/s: "), std::string::npos) << reported;
  EXPECT_NE(reported.find("a.stl cannot be read as a mesh"), std::string::npos) << reported;
  const std::string sphere = "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision>";
  std::vector<Problem> warnings;
  const SceneDescription scene =
      read_scene(write("s.sdf", model_with(sphere + mesh("a.stl", "visual"))), {}, &warnings);
  const std::string warning = lines_of(warnings);
  EXPECT_NE(warning.find("using the link's collision shapes instead"), std::string::npos) << warning;
  EXPECT_TRUE(std::holds_alternative<Sphere>(scene.models.at(1).links.at(0).visuals.at(0).geometry));
}

TEST_F(SceneFiles, MaterialScriptGivesItsColorAndItsTexture) {
  write("thing/materials/textures/two.ppm", "P6 2 1 255\n" + std::string("\xff\x80\x00\x00\x80\xff", 6));
  write("thing/materials/scripts/thing.material",
        "// paints\nmaterial Thing/Base\n{\n  technique\n  {\n    pass\n    {\n      diffuse 0.2 0.4 0.6 1.0\n"
        "      emissive 0.1 0 0\n    }\n  }\n}\nmaterial Thing/Picture : Thing/Base\n{\n technique\n {\n  pass\n  {\n"
        "   texture_unit\n   {\n    texture two.ppm\n   }\n  }\n }\n}\n");
  const auto material = [&](const std::string& name) {
    const std::string visual =
        "<visual name='v'><geometry><box><size>1 1 1</size></box></geometry><material><script>"
        "<uri>model://thing/materials/scripts</uri><uri>model://thing/materials/textures</uri><name>" +
        name + "</name></script></material></visual>";
    return read_scene(write("thing/model.sdf", model_with(visual))).models.at(1).links.at(0).visuals.at(0).material;
  };
  const Material base = material("Thing/Base");
  EXPECT_FLOAT_EQ(base.diffuse.g, 0.4F);
  EXPECT_FLOAT_EQ(base.emissive.r, 0.1F);
  EXPECT_EQ(base.texture, nullptr);
  const Material picture = material("Thing/Picture");
  EXPECT_FLOAT_EQ(picture.emissive.r, 0.1F);
  ASSERT_NE(picture.texture, nullptr);
  EXPECT_EQ(picture.texture->width, 2);
  EXPECT_FLOAT_EQ(picture.diffuse.r, 0.5F) << "the texture's mean colour, for shapes without texture coordinates";
  EXPECT_FLOAT_EQ(material("Gazebo/Red").diffuse.r, 1);
}

TEST_F(SceneFiles, InvisibleVisualsAreLeftOut) {
  EXPECT_TRUE(
      read_scene(write("s.sdf", model_with("<visual name='v'><transparency>1</transparency><geometry><box><size>1 1 1"
                                           "</size></box></geometry></visual>")))
          .models.at(1)
          .links.at(0)
          .visuals.empty());
}

TEST_F(SceneFiles, LinksWithoutWeightFloat) {
  const SceneDescription scene = read_scene(write("s.sdf", model_with("<gravity>false</gravity>")));
  World world(scene, 0);
  const ObjectId floating = world.tree().find("/m");
  world.advance(1, 0.005);
  EXPECT_EQ(world.pose(floating).position, Vector3::Zero());
}

TEST_F(SceneFiles, OfBeforeSdformat13AreReadWithTheirLines) {
  const std::string old =
      "<gazebo version='1.2'>\n<model name='old'>\n<link name='l'>\n<collision name='c'><geometry><sphere>"
      "<radius>%</radius></sphere></geometry></collision></link></model>\n</gazebo>\n";
  const auto with_radius = [&](const std::string& radius) {
    std::string text = old;
    return text.replace(text.find('%'), 1, radius);
  };
  EXPECT_EQ(read_scene(write("old.sdf", with_radius("1"))).models.at(1).name, "old");
  EXPECT_NE(reported_for(write("old.sdf", with_radius("-1"))).find("old.sdf:4: /old/l/c: the sphere's radius"),
            std::string::npos);
}

TEST_F(SceneFiles, OfUrdfAreLoadedWithTheirMeshesMaterialsAndExtensions) {
  write("pkg/package.xml", "<package><name>my_robot</name></package>");
  write("pkg/meshes/a.stl", kStl);
  const std::string urdf = R"(<robot name="bot">
<link name="base_footprint"/>
<joint name="up" type="fixed"><parent link="base_footprint"/><child link="base"/><origin xyz="0 0 0.5"/></joint>
<link name="base"><inertial><mass value="5"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><mesh filename="package://my_robot/meshes/a.stl" scale="2 2 2"/></geometry></visual>
<collision><geometry><box size="1 1 1"/></geometry></collision></link>
<link name="wheel"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><sphere radius="0.5"/></geometry></collision></link>
<joint name="axle" type="continuous"><parent link="base"/><child link="wheel"/><axis xyz="0 1 0"/></joint>
<transmission name="t"><type>transmission_interface/SimpleTransmission</type><joint name="axle"/></transmission>
<gazebo reference="wheel"><mu1>0.25</mu1></gazebo>
<gazebo><plugin name="drive" filename="libgazebo_ros_diff_drive.so"><leftJoint>axle</leftJoint></plugin></gazebo>
</robot>)";
  const ModelDescription bot = read_scene(write("pkg/urdf/bot.urdf", urdf)).models.at(1);
  ASSERT_EQ(bot.links.size(), 2U) << "fixed joints are lumped";
  ASSERT_EQ(bot.links[0].visuals.size(), 1U);
  EXPECT_EQ(std::get<Mesh>(bot.links[0].visuals[0].geometry).triangles->high.x(), 2);
  EXPECT_EQ(bot.links[1].collisions.at(0).surface.mu, 0.25);
  ASSERT_EQ(bot.joints.size(), 1U);
  EXPECT_EQ(bot.plugins.at(0).filename, "libgazebo_ros_diff_drive.so");
}

TEST_F(SceneFiles, OfXacroAreExpanded) {
  const std::string file = write("bot.urdf.xacro", R"(<robot name="bot" xmlns:xacro="http://ros.org/wiki/xacro">
<xacro:property name="r" value="${0.25 * 2}"/>
<link name="base"><inertial><mass value="5"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><sphere radius="${r}"/></geometry></collision></link></robot>)");
  const SceneDescription scene = read_scene(file);
  EXPECT_EQ(std::get<Sphere>(scene.models.at(1).links.at(0).collisions.at(0).geometry).radius, 0.5);
  const std::string reported = reported_for(write("bad.xacro", "<robot name='b'><link name='${nothing}'/></robot>"));
  EXPECT_NE(reported.find("bad.xacro: xacro failed: "), std::string::npos) << reported;
}

TEST_F(SceneFiles, WorldsIncludeTheSunAndTheGroundWithoutAnyFolder) {
  const SceneDescription scene = read_scene(
      write("w.world",
            in_world("<include><uri>model://sun</uri></include><include><uri>model://ground_plane</uri></include>")));
  EXPECT_EQ(scene.environment.lights.size(), 1U);
  EXPECT_EQ(scene.models.at(0).name, "ground_plane");
}

TEST_F(SceneFiles, ElementsThatAreNotUsedStopNothing) {
  const std::string world = in_world(R"(
<gui><camera name="user"><pose>1 2 3 0 0 0</pose></camera></gui>
<state world_name="w"><sim_time>1 2</sim_time></state>
<road name="r"><width>3</width><point>0 0 0</point><point>1 0 0</point></road>
<population name="p"><model name="x"><link name="l"/></model><model_count>3</model_count><distribution><type>random</type>
</distribution></population>
<wind><linear_velocity>1 0 0</linear_velocity></wind><atmosphere type="adiabatic"/><magnetic_field>1 0 0</magnetic_field>
<spherical_coordinates><latitude_deg>1</latitude_deg></spherical_coordinates>
<actor name="walker"><skin><filename>walk.dae</filename></skin><animation name="a"><filename>walk.dae</filename></animation>
<script><trajectory id="0" type="a"><waypoint><time>0</time><pose>0 0 0 0 0 0</pose></waypoint></trajectory></script>
</actor>
<audio><device>default</device></audio>
<model name="m"><allow_auto_disable>1</allow_auto_disable><link name="l"><kinematic>0</kinematic>
<velocity_decay><linear>0.1</linear></velocity_decay><unheard_of>5</unheard_of>
<projector name="p"><texture>t.png</texture></projector><audio_source><uri>x</uri></audio_source>
<collision name="c"><max_contacts>20</max_contacts><geometry><box><size>1 1 1</size></box></geometry><surface><friction>
<torsional><coefficient>1</coefficient></torsional><bullet><friction>1</friction></bullet></friction><soft_contact>
<dart><bone_attachment>1</bone_attachment></dart></soft_contact></surface></collision>
<visual name="v"><meta><layer>1</layer></meta><geometry><box><size>1 1 1</size></box></geometry><material><shader
 type="normal_map_tangent_space"><normal_map>n.png</normal_map></shader></material><plugin name="p" filename="p.so"/></visual>
</link><gripper name="g"><grasp_check/><gripper_link>l</gripper_link><palm_link>l</palm_link></gripper></model>)");
  EXPECT_EQ(reported_for(write("w.world", world)), "");
}

}  // namespace
}  // namespace bubblesim::test::test_scene_files
