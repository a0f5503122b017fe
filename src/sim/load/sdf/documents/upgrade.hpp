// SPDX-License-Identifier: BSD-3-Clause
// Brings documents of older versions of SDFormat to the newest.
#pragma once

#include "load/load_context.hpp"
#include "load/xml/xml_element.hpp"

namespace bubblesim {

/// Changes an <sdf>, or the <gazebo> of versions before 1.3, by the rules of the specification; reports a missing
/// version by a SceneError. Rules: 1.0 to 1.2 have attributes in place of elements; 1.3 the physics step in the
/// solver; 1.4 axes in the frame of the model; 1.5 gravity and magnetic field in <physics>, and one noise for each half
/// of an IMU; 1.6 <use_parent_model_frame>.
void upgrade(XmlElement& sdf, LoadContext& context);

}  // namespace bubblesim
