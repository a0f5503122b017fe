// SPDX-License-Identifier: BSD-3-Clause
// What contact sensors observe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bubblesim/scene.hpp"
#include "bubblesim/sensor.hpp"
#include "physics/contacts/found_contacts.hpp"

namespace bubblesim {

/// Two shapes that touched during the last advance(); a contact sensor observes the first.
struct Touch {
  const Collider* watched = nullptr;
  const Collider* other = nullptr;
  Vector3 impulse;            // on the first, N s
  std::uint64_t substep = 0;  // of the points
  std::vector<ContactPoint> points;
};

/// Of the last advance().
class Touches {
 public:
  std::vector<Touch> all;
  std::uint64_t substeps = 0;

  void clear();
  /// Adds the contacts of a substep that was solved.
  void add(const FoundContacts& found, double step);

 private:
  Touch& touch(const Collider* watched, const Collider* other);

  std::size_t next_ = 0;  // where the next touch is expected
};

}  // namespace bubblesim
