// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/script_files.hpp"

#include "files/file_text.hpp"

namespace bubblesim::ttt {

bool is_run(const Script& script) {
  if (script.is_disabled) return false;
  // V4 makes customization scripts of the image filters of old scenes.
  const bool is_filter = script.text.find("function sysCall_vision") != std::string::npos;
  return script.kind == ScriptKind::kChild || (script.kind == ScriptKind::kCustomization && is_filter);
}

std::map<int, std::string> write_scripts(const std::filesystem::path& folder, Conversion& conversion) {
  std::map<int, std::string> paths;
  UniqueNames names;
  std::vector<const Script*> run;
  for (const ScriptKind kind : {ScriptKind::kChild, ScriptKind::kCustomization}) {
    for (const Script& script : conversion.file.scripts) {
      if (script.kind == kind && is_run(script)) run.push_back(&script);
    }
  }
  for (const Script* each : run) {
    const Script& script = *each;
    const int object = conversion.structure.place(script.object);
    const int place = script.holder < 0 ? object : conversion.structure.place(script.holder);
    if (place == kNone) {
      conversion.left_out.add("script of no object: not run", "");
      continue;
    }
    const std::string& owner = conversion.object(object == kNone ? place : object).alias;
    constexpr unsigned kScriptsInactive = 0x200;
    if ((conversion.node(place).model_flags & kScriptsInactive) != 0) {
      conversion.left_out.add("script of a model whose scripts are inactive: not run", owner);
      continue;
    }
    if (paths.count(place) > 0) {
      conversion.left_out.add("second script of an object: not run", owner);
      continue;
    }
    const std::string path = "scripts/" + names.take(owner) + (script.is_python ? ".py" : ".lua");
    write_file(folder / path, script.text);
    conversion.parameters[place] = script.parameters;
    paths.emplace(place, path);
  }
  return paths;
}

}  // namespace bubblesim::ttt
