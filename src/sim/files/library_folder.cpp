// SPDX-License-Identifier: BSD-3-Clause
#include "files/library_folder.hpp"

#include <dlfcn.h>

namespace bubblesim {

std::filesystem::path library_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<void*>(&library_folder), &info) == 0 || info.dli_fname == nullptr) return {};
  // /lib is a link to /usr/lib, where the data of an installed package is.
  return std::filesystem::weakly_canonical(std::filesystem::absolute(info.dli_fname).parent_path());
}

}  // namespace bubblesim
