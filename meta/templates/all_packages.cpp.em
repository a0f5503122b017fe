@# Context:
@#   packages       names of the message packages of ROS 1
@#   ros2_packages  the same of ROS 2; none in a build without it
// generated from meta/messages.txt and meta/services.txt, do not edit
#include "message_tables.hpp"

namespace bubblesim::messages::tables {

@[for package in packages]@
PackageTable package_@(package)();
@[end for]@
@[for package in ros2_packages]@
PackageTable ros2_package_@(package)();
@[end for]@

std::vector<PackageTable> all_packages(RosVersion version) {
  if (version == RosVersion::kRos2) {
    return {
@[for package in ros2_packages]@
        ros2_package_@(package)(),
@[end for]@
    };
  }
  return {
@[for package in packages]@
      package_@(package)(),
@[end for]@
  };
}

}  // namespace bubblesim::messages::tables
