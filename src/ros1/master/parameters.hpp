// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "master/master_call.hpp"

namespace bubblesim {

class MasterThread;

/// The parameters of the master; see messages::Bridge. For the simulation thread.
class Parameters {
 public:
  explicit Parameters(MasterThread& master) : master_(master) {}

  std::optional<messages::ParameterValue> get(const std::string& name);
  void set(const std::string& name, const messages::ParameterValue& value);
  void remove(const std::string& name);
  std::optional<std::string> search(const std::string& name);

 private:
  RpcAnswer ask(const char* method, const std::string& argument);

  MasterThread& master_;
};

}  // namespace bubblesim
