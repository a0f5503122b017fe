// SPDX-License-Identifier: BSD-3-Clause
// What a main script of a scene's own does beside what each main script does.
#pragma once

#include <set>
#include <string>

namespace bubblesim::ttt {

/// The functions of the API that a script in Lua calls, without those that call the phases of a simulation step: these
/// run here in any case. Names as in `sim.setJointPosition`; empty: it does what the default main script does.
std::set<std::string> calls_beside_phases(const std::string& text);

}  // namespace bubblesim::ttt
