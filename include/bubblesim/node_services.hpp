// SPDX-License-Identifier: BSD-3-Clause
// The ROS services and topics of the node, as a system of a simulation.
#pragma once

#include <string>

#include "bubblesim/child_scripts.hpp"

namespace bubblesim {

/// Advertises the services and topics that control and observe the simulation. Needs a bridge. Add it after the
/// scripts: the message of a completed step comes after all others.
class NodeServices final : public PythonSystem {
 public:
  /// `gazebo_names`: also those of Gazebo. `node_name`: the full name, whose services some of Gazebo's may be. The
  /// scripts must outlive this object.
  NodeServices(PythonEngine& engine, const ChildScripts& scripts, bool gazebo_names, const std::string& node_name);
};

}  // namespace bubblesim
