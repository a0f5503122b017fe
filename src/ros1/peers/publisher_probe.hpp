// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "peers/type_version.hpp"

namespace bubblesim {

/// Queries the type of a topic from a publisher, by connecting as a subscriber of any type and closing the connection
/// after the header. Runs on roscpp's threads, which also call `on_answer`; does not wait for a node that does not
/// answer.
void probe_publisher(const std::string& topic, const std::string& node_uri,
                     std::function<void(const TypeVersion&)> on_answer);

}  // namespace bubblesim
