// SPDX-License-Identifier: BSD-3-Clause
// Gives each object a name that its siblings do not have, where Gazebo takes files with equal ones.
#pragma once

#include <string>
#include <vector>

#include "load/load_context.hpp"
#include "load/xml/xml_element.hpp"

namespace bubblesim {

/// Numbers the models among the children of a world or model whose names are taken, with a warning: name_2. `places`
/// has the place of each child in the file that has it: that of an <include>, not of the model that replaced it.
void number_models(std::vector<XmlElement>& children, const std::vector<Source>& places, const std::string& path,
                   LoadContext& context);

/// Works on a <sdf>, <world>, <model> or <link> and all below it; `path` is that of its object. Joints, collisions,
/// visuals and sensors with the name of another get a number, with a warning: name_2. A joint or frame with
/// the name of a link or model becomes NAME_joint or NAME_frame. Of lights with one name the first is kept. Links keep
/// their names, because joints refer to them: the check of the scene reports equal ones.
void make_names_unique(XmlElement& owner, const std::string& path, LoadContext& context);

}  // namespace bubblesim
