// SPDX-License-Identifier: BSD-3-Clause
// The buoyancy of links in fluids.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bubblesim/device.hpp"

namespace bubblesim {

struct FluidLayer {
  double above;    ///< m, world z at which the layer begins; it ends where the next one begins
  double density;  ///< kg/m^3
};

/// Pushes moving links with the weight of the fluid that their collision shapes displace, at the centroid of the
/// displaced volume (Archimedes). Boxes, spheres, ellipsoids and closed meshes that cross a surface displace what is
/// below it exactly, cylinders and capsules to 1e-6 of their volume; overlapping shapes of a link count several times.
/// There is no drag and no added mass.
class Buoyancy final : public Device {
 public:
  /// `bottom_density` is that of the fluid below all layers, in kg/m^3. `paths` are those of the models and links that
  /// it acts on, also if they are added later; empty: all. Throws InvalidInput unless densities are from 0 to 1e6 and
  /// the layers begin at increasing finite heights.
  Buoyancy(double bottom_density, std::vector<FluidLayer> layers, std::vector<std::string> paths);
  ~Buoyancy() override;

  /// Replaces the collision shapes of a link by a volume in m^3 at a point in the link's frame; it displaces the fluid
  /// of the layer in which that point is. Throws InvalidInput unless the volume is above 0 and at most 1e15 m^3, and
  /// WrongObject when the object is not a moving link.
  void set_volume(const World& world, ObjectId link, double volume, const Vector3& centre);

  void update(World& world, double time, double duration) override;

 private:
  struct Solid;
  struct Floating;
  struct Given {
    double volume;
    Vector3 centre;
  };

  void find_links(const World& world);
  void lift(World& world, const Floating& link, const Solid& solid) const;
  double density_at(double height) const;

  std::vector<FluidLayer> layers_;  // the first one begins at minus infinity
  std::vector<std::string> paths_;
  std::map<ObjectId, Given> given_;
  std::vector<Floating> links_;
  std::optional<std::uint64_t> revision_;  // of the world in which the links were found
};

}  // namespace bubblesim
