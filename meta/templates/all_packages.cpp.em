@# Context:
@#   packages  names of the message packages
// generated from meta/messages.txt and meta/services.txt, do not edit
#include "message_tables.hpp"

namespace bubblesim::messages::tables {

@[for package in packages]@
PackageTable package_@(package)();
@[end for]@

std::vector<PackageTable> all_packages() {
  return {
@[for package in packages]@
      package_@(package)(),
@[end for]@
  };
}

}  // namespace bubblesim::messages::tables
