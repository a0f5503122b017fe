// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/script_files.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace bubblesim::ttt {

std::map<int, std::string> write_scripts(const std::filesystem::path& folder, Conversion& conversion) {
  std::map<int, std::string> paths;
  UniqueNames names;
  const auto& objects = conversion.file.objects;
  for (const Script& script : conversion.file.scripts) {
    if (script.kind != ScriptKind::kChild || script.is_disabled) continue;
    const auto owner = std::find_if(objects.begin(), objects.end(),
                                    [&script](const Object& object) { return object.handle == script.object; });
    if (owner == objects.end()) {
      conversion.left_out.add("script of no object: not run", "");
      continue;
    }
    const auto place = static_cast<int>(owner - objects.begin());
    if (paths.count(place) > 0) {
      conversion.left_out.add("second script of an object: not run", owner->alias);
      continue;
    }
    const std::string path = "scripts/" + names.take(owner->alias) + (script.is_python ? ".py" : ".lua");
    std::filesystem::create_directories(folder / "scripts");
    std::ofstream stream(folder / path, std::ios::binary);
    stream.write(script.text.data(), static_cast<std::streamsize>(script.text.size()));
    if (!stream.flush()) throw std::runtime_error("cannot write " + (folder / path).string() + ": is the disk full?");
    paths.emplace(place, path);
  }
  return paths;
}

}  // namespace bubblesim::ttt
