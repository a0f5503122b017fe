// SPDX-License-Identifier: BSD-3-Clause
// What is remembered of contacts from one substep to the next. It is part of a world's state.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "bubblesim/math.hpp"
#include "physics/contacts/contact_points.hpp"
#include "physics/contacts/found_contacts.hpp"

namespace bubblesim {

class Fnv1a;

struct RememberedPoint {
  Vector3 position;   ///< m, in the world
  Vector3 direction;  ///< of the normal force on the first shape, unit vector in the world
  double normal = 0;  ///< N, normal force
  Vector3 friction;   ///< N, on the first shape, in world axes
  Vector3 torque;     ///< N m, likewise: resistance to rolling and spinning
  double limit = 0;   ///< N, normal force by which the next substep limits the friction
};

struct RememberedPair {
  const Collider* first = nullptr;
  const Collider* second = nullptr;
  std::size_t begin = 0;  ///< of its points
  int count = 0;
  int age = 0;             ///< substeps since the shapes began to touch
  double load = 0;         ///< N, sum of the normal forces
  double load_before = 0;  ///< N, of the substep before
};

struct ContactMemory {
  std::vector<RememberedPair> pairs;  ///< in the order of the numbers of their shapes
  std::vector<RememberedPoint> points;

  void clear();
  void add_to(Fnv1a& hash) const;
};

/// What a contact of this substep can expect.
struct ExpectedContact {
  double normal = 0;  ///< N
  Vector3 friction;   ///< N, on the first shape
  Vector3 torque;     ///< N m, likewise: resistance to rolling and spinning
  double limit = 0;   ///< N, normal force by which the friction is limited
};

/// Looks pairs up in their order; a pair that is asked for must come after the one asked for before.
class ContactLookup {
 public:
  explicit ContactLookup(const ContactMemory& memory) : memory_(memory) {}

  /// The pair of the last substep; null when it did not touch then.
  const RememberedPair* pair(const FoundPair& pair);

 private:
  const ContactMemory& memory_;
  std::size_t next_ = 0;
};

/// Whether the forces of a pair have come to a value that the next substep may rely on: not after an impact.
bool is_settled(const RememberedPair& pair);

using ExpectedContacts = std::array<ExpectedContact, kMaxContactsPerPair>;

/// Distributes the load of a pair among its points of this substep, by the nearest points of the last.
ExpectedContacts expect(const ContactMemory& memory, const RememberedPair& remembered, const FoundPair& pair,
                        const FoundContact* points, double step);

/// Replaces the memory by the contacts of the substep that was just solved. `before` is working memory.
void remember_contacts(const FoundContacts& found, ContactMemory& memory, ContactMemory& before);

/// Moves the pairs of which both bodies sleep to `asleep`, and the others to `memory`.
void sort_by_sleep(ContactMemory& memory, ContactMemory& asleep);

/// Drops the contacts of the shapes for which `belongs` is true: of a model that was moved or will be removed.
void forget_contacts(ContactMemory& memory, const std::function<bool(const Collider&)>& belongs);

}  // namespace bubblesim
