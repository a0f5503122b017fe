// SPDX-License-Identifier: BSD-3-Clause
// The places of objects in the tree, and the frames.
#include <map>
#include <set>
#include <string>

#include "validation/checker.hpp"

namespace bubblesim {
namespace {

/// Finds places that are used twice, lead nowhere, or form circles.
class PlaceCheck {
 public:
  explicit PlaceCheck(Checker& checker) : checker_(checker) {}

  template <class Part>
  void add(const Part& part, const std::string& path) {
    if (!part.place) return;
    const auto [known, is_new] = places_.insert({part.place->id, {part.place->parent, part.source, path}});
    if (is_new) return;
    checker_.at(part.source, path);
    checker_.report("the place " + std::to_string(part.place->id) + " in the tree is that of " + known->second.path +
                    " too; each object needs its own");
  }

  /// `is_whole`: the parents of all are among them.
  void finish(bool is_whole) {
    const std::set<int> below_themselves = circles();
    for (const auto& [id, place] : places_) {
      checker_.at(place.source, place.path);
      if (is_whole && place.parent >= 0 && places_.count(place.parent) == 0) {
        checker_.report("its parent in the tree, " + std::to_string(place.parent) + ", is the place of no object");
      }
      if (below_themselves.count(id) > 0) checker_.report("it is below itself in the tree");
    }
  }

 private:
  struct Known {
    int parent = -1;
    Source source;
    std::string path;
  };

  /// The places that are below themselves. Each is passed once: a tree may be as deep as the file has objects.
  std::set<int> circles() const {
    std::set<int> found;
    std::map<int, int> starts;  // by place: where the way up began that passed it first
    for (const auto& [id, place] : places_) {
      int at = id;
      while (places_.count(at) > 0 && starts.emplace(at, id).second) at = places_.at(at).parent;
      if (places_.count(at) == 0 || starts.at(at) != id) continue;
      for (int up = at; found.insert(up).second;) up = places_.at(up).parent;
    }
    return found;
  }

  Checker& checker_;
  std::map<int, Known> places_;
};

void add_places(PlaceCheck& places, const ModelDescription& model) {
  const std::string path = "/" + model.name + "/";
  const auto add_sensors = [&](const auto& carrier) {
    for (const SensorDescription& sensor : carrier.sensors) {
      places.add(sensor, path + carrier.name + "/" + sensor.name);
    }
  };
  for (const LinkDescription& link : model.links) {
    places.add(link, path + link.name);
    add_sensors(link);
  }
  for (const JointDescription& joint : model.joints) {
    places.add(joint, path + joint.name);
    add_sensors(joint);
  }
  for (const FrameDescription& frame : model.frames) places.add(frame, path + frame.name);
}

}  // namespace

void check_places(Checker& checker, const SceneDescription& scene) {
  PlaceCheck places(checker);
  for (const ModelDescription& model : scene.models) add_places(places, model);
  for (const FrameDescription& frame : scene.frames) places.add(frame, "/" + frame.name);
  places.finish(true);
}

void check_places(Checker& checker, const ModelDescription& model) {
  PlaceCheck places(checker);
  add_places(places, model);
  places.finish(false);
}

}  // namespace bubblesim
