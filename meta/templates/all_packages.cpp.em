@# Context:
@#   packages       names of the message packages of ROS 1
@#   ros2_packages  the same of ROS 2; none in a build without it
@#   older_packages  those whose types had other fields before Iron
// generated from meta/messages.txt and meta/services.txt, do not edit
#include "message_tables.hpp"

namespace bubblesim::messages::tables {

@[for package in packages]@
PackageTable package_@(package)();
@[end for]@
@[for package in ros2_packages]@
PackageTable ros2_package_@(package)();
@[end for]@
@[for package in older_packages]@
PackageTable older_package_@(package)();
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

std::vector<PackageTable> packages_before_iron() {
  return {
@[for package in older_packages]@
      older_package_@(package)(),
@[end for]@
  };
}

}  // namespace bubblesim::messages::tables
