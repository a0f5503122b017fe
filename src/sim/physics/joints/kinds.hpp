// SPDX-License-Identifier: BSD-3-Clause
// Factory functions of the joint kinds. A new kind adds its file, its line here and its line in registry.cpp.
#pragma once

#include "physics/joints/joint.hpp"

namespace bubblesim {

std::unique_ptr<Joint> make_hinge(dWorldID, const JointDescription&, const JointSite&);
std::unique_ptr<Joint> make_slider(dWorldID, const JointDescription&, const JointSite&);
std::unique_ptr<Joint> make_fixed(dWorldID, const JointDescription&, const JointSite&);
std::unique_ptr<Joint> make_ball(dWorldID, const JointDescription&, const JointSite&);
std::unique_ptr<Joint> make_hinge2(dWorldID, const JointDescription&, const JointSite&);
std::unique_ptr<Joint> make_universal(dWorldID, const JointDescription&, const JointSite&);
std::unique_ptr<Joint> make_screw(dWorldID, const JointDescription&, const JointSite&);
std::unique_ptr<Joint> make_gearbox(dWorldID, const JointDescription&, const JointSite&);

}  // namespace bubblesim
