// SPDX-License-Identifier: BSD-3-Clause
// The readers of the kinds of objects. Each takes the second list of an object, which its kind alone has, and throws
// FormatError.
#pragma once

#include "load/ttt/mesh_data.hpp"
#include "load/ttt/scene_file.hpp"
#include "load/ttt/tag_list.hpp"

namespace bubblesim::ttt {

/// The materials of old files, by id, and the arrays of the file.
struct ShapeSources {
  const MeshData& meshes;
  const std::map<int, TagList>& materials;
  std::size_t triangles_left;  ///< limit of the file
};

Shape read_shape(const TagList& list, ShapeSources& sources);
Joint read_joint(const TagList& list);
ProximitySensor read_proximity_sensor(const TagList& list);
VisionSensor read_vision_sensor(const TagList& list);
ForceSensor read_force_sensor(const TagList& list);
Dummy read_dummy(const TagList& list);
Lamp read_lamp(const TagList& list);
Path read_path(const TagList& list);

/// The list of a script, at the top level or in an object.
Script read_script(const TagList& list);
/// The parameters in an item `Par`.
std::vector<Parameter> read_parameters(const TagList& list);
/// The custom data of an object, by name; old data have a number instead, such as `#1234`. Takes its first list.
std::map<std::string, std::string> read_custom_data(const TagList& common);
/// The list GRP.
Collection read_collection(const TagList& list);
/// A script's text as it is read by people.
std::string clear_text(std::string_view obscured);

/// Of a scene: the lists SIM, DYN, ENV and SET.
Settings read_settings(const TagList& sim, const TagList& dyn, const TagList& env, const TagList& set);

}  // namespace bubblesim::ttt
