// SPDX-License-Identifier: BSD-3-Clause
// Collision detection.
#pragma once

#include "physics/contacts/substep.hpp"

namespace bubblesim {

/// Searches the contacts of all awake bodies, and removes the contact joints of the last substep.
void search_contacts(Substep& substep);

/// Puts the pairs that were found in an order that depends on the state only, and drops pairs that the filter refuses
/// and points that are not needed.
void order_contacts(Contacts& contacts);

}  // namespace bubblesim
