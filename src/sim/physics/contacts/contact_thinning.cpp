// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/contact_thinning.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "physics/contacts/contact_points.hpp"
#include "physics/parts/collider.hpp"

namespace bubblesim {
namespace {

constexpr std::size_t kEnough = 4;   // points on a plane
constexpr double kSamePlane = 0.99;  // cosine between normals

/// Contacts of two links, as indices into all contacts.
using Patch = std::vector<std::size_t>;

bool same_surface(const dSurfaceParameters& a, const dSurfaceParameters& b) {
  const auto values = [](const dSurfaceParameters& s) {
    return std::tie(s.mu, s.mu2, s.rho, s.rhoN, s.bounce, s.bounce_vel, s.soft_erp, s.soft_cfm, s.slip1, s.slip2);
  };
  return values(a) == values(b);  // unused values are 0 in both
}

bool belong_together(const dContact& a, const dContact& b) {
  return dCalcVectorDot3(a.geom.normal, b.geom.normal) > kSamePlane && same_surface(a.surface, b.surface);
}

/// The patches of islands with many contacts; a patch consists of contacts between the same two links.
std::map<int, std::vector<Patch>> patches_by_island(const FoundContacts& found, Islands& islands) {
  std::map<std::pair<const Link*, const Link*>, std::vector<std::size_t>> by_links;  // indices into `all`
  std::vector<std::pair<int, Patch>> all;
  for (const FoundPair& pair : found.pairs) {
    const int island = islands.of(pair.first->model);
    if (!islands.is_jointed(island) || islands.contacts(island) <= Islands::kMaxContacts) continue;
    std::vector<std::size_t>& patches = by_links[std::minmax(pair.first->link, pair.second->link)];
    for (std::size_t i = pair.begin; i < pair.begin + static_cast<std::size_t>(pair.count); ++i) {
      const auto patch = std::find_if(patches.begin(), patches.end(), [&](std::size_t other) {
        return belong_together(found.points[all[other].second.front()].contact, found.points[i].contact);
      });
      if (patch == patches.end()) {
        patches.push_back(all.size());
        all.push_back({island, {i}});
      } else {
        all[*patch].second.push_back(i);
      }
    }
  }
  std::map<int, std::vector<Patch>> sorted;
  for (auto& [island, patch] : all) sorted[island].push_back(std::move(patch));
  return sorted;
}

/// Selects the contacts of a patch that are enough to hold it.
Patch enough(const Patch& patch, const std::vector<FoundContact>& found) {
  if (patch.size() <= kEnough) return patch;
  std::vector<dContactGeom> points;
  points.reserve(patch.size());
  for (const std::size_t i : patch) points.push_back(found[i].contact.geom);
  Patch kept;
  for (const std::size_t i : spread(points, kEnough)) kept.push_back(patch[i]);
  return kept;
}

void keep_only(const std::vector<bool>& keep, FoundContacts& found) {
  FoundContacts kept;
  for (const FoundPair& pair : found.pairs) {
    FoundPair left{pair.first, pair.second, kept.points.size(), 0};
    for (std::size_t i = pair.begin; i < pair.begin + static_cast<std::size_t>(pair.count); ++i) {
      if (keep[i]) kept.points.push_back(found.points[i]);
    }
    left.count = static_cast<int>(kept.points.size() - left.begin);
    if (left.count > 0) kept.pairs.push_back(left);
  }
  found = std::move(kept);
}

}  // namespace

void thin_out(FoundContacts& found, Islands& islands) {
  std::vector<bool> keep(found.points.size(), true);
  bool dropped = false;
  for (const auto& [island, patches] : patches_by_island(found, islands)) {
    std::vector<Patch> kept;
    int count = 0;
    for (const Patch& patch : patches) {
      kept.push_back(enough(patch, found.points));
      count += static_cast<int>(kept.back().size());
    }
    if (count > islands.limit(island)) continue;
    islands.set_contacts(island, count);
    dropped = true;
    for (const Patch& patch : patches) {
      for (const std::size_t i : patch) keep[i] = false;
    }
    for (const Patch& patch : kept) {
      for (const std::size_t i : patch) keep[i] = true;
    }
  }
  if (dropped) keep_only(keep, found);
}

}  // namespace bubblesim
