// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace bubblesim {

/// Calls ros::init() for this process and removes the remappings from the command line. Does not connect yet.
/// Throws std::invalid_argument for a master URI or node name that roscpp cannot use (where it would abort), and
/// std::logic_error if called a second time.
void init_node(int& argc, char** argv, const std::string& default_name);

}  // namespace bubblesim
