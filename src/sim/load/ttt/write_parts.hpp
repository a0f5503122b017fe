// SPDX-License-Identifier: BSD-3-Clause
// The parts of a link: collisions, visuals, sensors, lights.
#pragma once

#include <map>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "load/ttt/left_out.hpp"
#include "load/ttt/mesh_files.hpp"
#include "load/ttt/structure.hpp"

namespace bubblesim::ttt {

/// What the writers of parts share.
struct Conversion {
  const SceneFile& file;
  const Structure& structure;
  MeshFiles meshes;
  LeftOut left_out;
  UniqueNames names;                                   ///< of all that has a name
  std::map<int, std::string> scripts{};                ///< the files of the scripts, by object
  std::map<int, std::vector<Parameter>> parameters{};  ///< of the scripts, by object
  std::set<int> placed{};                              ///< the objects that have a place in the tree
  std::map<int, std::string> joints{};                 ///< the names of the joints, by object
  std::map<int, std::string> links{};  ///< the names of the links that are shapes, or have them, by object
  std::vector<std::pair<int, pugi::xml_node>> entities{};  ///< what proximity sensors detect, and their elements

  const Object& object(int i) const { return file.objects[static_cast<std::size_t>(i)]; }
  const Node& node(int i) const { return structure.nodes[static_cast<std::size_t>(i)]; }
};

/// How the shapes of a link collide.
struct LinkKind {
  bool is_static = false;  ///< of a static model
  bool is_wheel = false;   ///< on a revolute joint in dynamic mode
};

/// Adds the collisions and visuals of a shape, if it has any. `link_pose`: of the link, in the world of the file.
void write_shape(pugi::xml_node link, int shape, const Pose& link_pose, const LinkKind& kind, Conversion& conversion);
/// Adds the decay of the velocity of a body, by the material for the engine that the file used.
void write_damping(pugi::xml_node link, const Shape& shape, const Settings& settings);
/// Adds a proximity or vision sensor.
void write_sensor(pugi::xml_node link, int sensor, const Pose& link_pose, Conversion& conversion);
/// Adds the place of an object in the tree that scripts see, with its script.
void write_place(pugi::xml_node element, int object, Conversion& conversion);
/// Adds an object without physics; `link` carries it, or nothing if that is empty.
void write_frame(pugi::xml_node owner, int object, const std::string& link, const Pose& link_pose,
                 Conversion& conversion);
/// Adds the collections that the file has saved, for scripts.
void write_collections(pugi::xml_node world, const SceneFile& file);
/// Completes the proximity sensors that detect only some objects, when all links are written.
void write_entities(Conversion& conversion);
/// Adds a light that is on, to the world or to a link.
void write_lamp(pugi::xml_node parent, int lamp, const Pose& parent_pose, Conversion& conversion);

}  // namespace bubblesim::ttt
