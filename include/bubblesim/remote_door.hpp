// SPDX-License-Identifier: BSD-3-Clause
// The door for programs outside, as a system of a simulation.
#pragma once

#include <string>

#include "bubblesim/child_scripts.hpp"

namespace bubblesim {

/// Serves CoppeliaSim's remote clients: calls of `sim` functions over ZeroMQ, answered between steps. Add it after the
/// other systems, so that a client whose step is done finds all results of the step.
class RemoteDoor final : public PythonSystem {
 public:
  /// Listens on `address`:`port`; throws std::runtime_error when that is not possible. The scripts must outlive it.
  RemoteDoor(PythonEngine& engine, const ChildScripts& scripts, const std::string& address, int port);
  ~RemoteDoor() override;
  RemoteDoor(const RemoteDoor&) = delete;
  RemoteDoor& operator=(const RemoteDoor&) = delete;

  /// Sends an error to the clients that wait, and stops listening.
  void close();
};

}  // namespace bubblesim
