// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace bubblesim {

/// ros::init() for this process, with the remappings of the command line, which it takes out. It talks to nobody yet.
/// Throws std::invalid_argument for a master URI or node name that roscpp cannot use (where it would abort), and
/// std::logic_error when called a second time.
void init_node(int& argc, char** argv, const std::string& default_name);

}  // namespace bubblesim
