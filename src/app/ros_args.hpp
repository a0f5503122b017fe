// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace bubblesim::app {

/// The command line with ROS 2's arguments in the spelling of ROS 1, which both bridges take: `--ros-args -r a:=b -p
/// c:=1
/// --` as `a:=b _c:=1`. Rules for other nodes than this apply to it, too; options for logs are left out. Throws
/// std::invalid_argument for others.
std::vector<std::string> with_plain_ros_args(int argc, char** argv);

}  // namespace bubblesim::app
