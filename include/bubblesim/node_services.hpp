// SPDX-License-Identifier: BSD-3-Clause
// The ROS services and topics of the node, as a system of a simulation.
#pragma once

#include "bubblesim/child_scripts.hpp"

namespace bubblesim {

/// Advertises the services and topics that control and observe the simulation. Needs a bridge. Add it after the
/// scripts: the message of a completed step comes after all others.
class NodeServices final : public PythonSystem {
 public:
  /// `gazebo_names`: also those of Gazebo. The scripts must outlive this object.
  NodeServices(PythonEngine& engine, const ChildScripts& scripts, bool gazebo_names);
};

}  // namespace bubblesim
