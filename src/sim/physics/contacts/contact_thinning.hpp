// SPDX-License-Identifier: BSD-3-Clause
// Reduces the contacts of two links to those that hold them.
#pragma once

#include "physics/contacts/found_contacts.hpp"
#include "physics/contacts/islands.hpp"

namespace bubblesim {

/// Wheels with several shapes, and meshes, touch the ground in more points than necessary. In each island with joints
/// and more contacts than the exact solver takes, and only if the result is few enough, keeps four of the contacts of
/// two links on one plane with equal surface parameters: those that are farthest apart. The order is kept.
void thin_out(FoundContacts& found, Islands& islands);

}  // namespace bubblesim
