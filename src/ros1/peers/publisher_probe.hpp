// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "peers/type_version.hpp"

namespace bubblesim {

/// Asks a node as what it publishes a topic, by connecting as a subscriber that takes any type, and dropping the
/// connection when its header is there. All of it happens on roscpp's own threads, where `on_answer` is called, too; a
/// node that does not answer is not waited for.
void probe_publisher(const std::string& topic, const std::string& node_uri,
                     std::function<void(const TypeVersion&)> on_answer);

}  // namespace bubblesim
