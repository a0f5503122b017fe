// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/buoyancy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "devices/displaced_volume.hpp"
#include "devices/link_bodies.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

constexpr double kMaxDensity = 1e6;  // kg/m^3
constexpr double kMaxVolume = 1e15;  // m^3

/// Whether an object is at that path or below it.
bool is_below(const std::string& object, const std::string& path) {
  return object == path || (object.size() > path.size() && object[path.size()] == '/' && object.rfind(path, 0) == 0);
}

}  // namespace

struct Buoyancy::Solid {
  const CollisionDescription* shape;
  double reach;    // m
  Displaced full;  // when it is in one fluid
};

struct Buoyancy::Floating {
  ObjectId link;
  std::vector<Solid> solids;
  std::optional<Given> given;
};

Buoyancy::Buoyancy(double bottom_density, std::vector<FluidLayer> layers, std::vector<std::string> paths)
    : layers_(std::move(layers)), paths_(std::move(paths)) {
  layers_.insert(layers_.begin(), FluidLayer{-std::numeric_limits<double>::infinity(), bottom_density});
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const auto& [above, density] = layers_[i];
    if (!(density >= 0 && density <= kMaxDensity)) {
      throw InvalidInput("the density " + text(density) + " kg/m^3 of a fluid is not usable: it must be from 0 to 1e6");
    }
    if (i == 0 || (within(above, kMaxDistance) && above > layers_[i - 1].above)) continue;
    throw InvalidInput("a fluid above " + text(above) +
                       " m is not usable: heights must be finite, at most 1e6 and increase from layer to layer");
  }
}

Buoyancy::~Buoyancy() = default;

void Buoyancy::set_volume(const World& world, ObjectId link, double volume, const Vector3& centre) {
  check_pushable(world, link);
  if (!(volume > 0 && volume <= kMaxVolume) || !within(centre, kMaxSize)) {
    throw InvalidInput(world.tree().short_path(link) + ": the volume " + text(volume) + " m^3 at " + text(centre) +
                       " m is not usable: it must be above 0 and at most 1e15, at a finite point");
  }
  given_[link] = {volume, centre};
  revision_.reset();
}

void Buoyancy::find_links(const World& world) {
  links_.clear();
  for (const ObjectId link : moving_links(world, [](const LinkDescription&) { return true; })) {
    const std::string path = world.tree().path(link);
    const bool wanted =
        std::any_of(paths_.begin(), paths_.end(), [&](const auto& each) { return is_below(path, each); });
    if (!wanted && !paths_.empty()) continue;
    Floating floating{link, {}, std::nullopt};
    if (const auto found = given_.find(link); found != given_.end()) {
      floating.given = found->second;
    } else {
      for (const CollisionDescription& shape : link_description(world, link).collisions) {
        const double reach = reach_of(shape.geometry);
        Displaced full = displaced_below(shape.geometry, Vector3::UnitZ(), 2 * reach);
        if (full.volume > 0) floating.solids.push_back({&shape, reach, full});
      }
    }
    links_.push_back(std::move(floating));
  }
  revision_ = world.revision();
}

double Buoyancy::density_at(double height) const {
  const auto above = [](double z, const FluidLayer& layer) { return z < layer.above; };
  return std::prev(std::upper_bound(layers_.begin(), layers_.end(), height, above))->density;
}

void Buoyancy::lift(World& world, const Floating& link, const Solid& solid) const {
  const Pose pose = world.pose(link.link) * solid.shape->pose;
  const Vector3 up = pose.orientation.conjugate() * Vector3::UnitZ();
  const double z = pose.position.z();
  Displaced below;  // the layers so far
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const double surface = i + 1 < layers_.size() ? layers_[i + 1].above : std::numeric_limits<double>::infinity();
    if (surface <= z - solid.reach) continue;
    const bool contains_rest = surface >= z + solid.reach;
    const Displaced next = contains_rest ? solid.full : displaced_below(solid.shape->geometry, up, surface - z);
    const double volume = next.volume - below.volume;
    if (volume > 0) {
      const Vector3 centroid = (next.moment - below.moment) / volume;
      world.wrenches().apply(link.link, {-world.properties().gravity() * (layers_[i].density * volume), {}},
                             pose * centroid);
    }
    if (contains_rest) return;
    below = next;
  }
}

void Buoyancy::update(World& world, double, double) {
  if (revision_ != world.revision()) find_links(world);
  for (const Floating& link : links_) {
    if (link.given) {
      const Vector3 centre = world.pose(link.link) * link.given->centre;
      world.wrenches().apply(
          link.link, {-world.properties().gravity() * (density_at(centre.z()) * link.given->volume), {}}, centre);
    }
    for (const Solid& solid : link.solids) lift(world, link, solid);
  }
}

}  // namespace bubblesim
