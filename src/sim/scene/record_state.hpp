// SPDX-License-Identifier: BSD-3-Clause
// Records in saved states.
#pragma once

#include "bubblesim/any_record.hpp"
#include "bubblesim/state_archive.hpp"

namespace bubblesim {

/// Saves or restores the stored members of a record, in the order of their list. The record to restore has the type of
/// the one that was saved.
void transfer_record(StateArchive& archive, AnyRecord& record);

}  // namespace bubblesim
