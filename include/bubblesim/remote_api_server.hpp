// SPDX-License-Identifier: BSD-3-Clause
// The remote API server, as a system of a simulation.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "bubblesim/child_scripts.hpp"
#include "bubblesim/prepared_scene.hpp"

namespace bubblesim {

struct RemoteApiOptions {
  std::string address = "127.0.0.1";
  std::optional<int> port;       ///< TCP; 0: a free one, null: none
  std::filesystem::path socket;  ///< Unix domain, in a folder that only this user may enter; empty: none
  std::filesystem::path token;   ///< file with the secret that clients must know; empty: none
  bool trusted = false;          ///< clients may do what Python child scripts may do: start all programs, use all files
  /// Why clients cannot load another scene; empty if they can.
  std::string fixed_scene;
};

/// Serves CoppeliaSim's remote clients: calls of `sim` functions over ZeroMQ, answered between steps. Add it to a
/// simulation after the other systems, so that a client whose step is done finds all results of the step.
///
/// It listens from its creation on, and outlasts the simulations of the scenes that its clients load.
class RemoteApiServer final : public PythonSystem {
 public:
  /// Throws std::runtime_error when it cannot listen.
  RemoteApiServer(PythonEngine& engine, const RemoteApiOptions& options);
  ~RemoteApiServer() override;
  RemoteApiServer(const RemoteApiServer&) = delete;
  RemoteApiServer& operator=(const RemoteApiServer&) = delete;

  /// Serves the simulation of these scripts, which must outlive this until detach(). `failure`: why the scene that a
  /// client asked for is not the one that runs now.
  void attach(const ChildScripts& scripts, const std::string& failure = {});
  /// Lets clients wait for the next attach().
  void detach();
  /// The scene that a client has asked for since the last call; null if there is none.
  std::shared_ptr<const Scene> take_next_scene();
  void publish(const World& world, double time) override;

  /// Sends an error to the clients that wait, and stops listening.
  void close();

 private:
  bool closed_ = false;
  bool has_clients_ = false;  // without any, a step makes no call
};

}  // namespace bubblesim
