// Orders values that depend on each other, and reports cycles (internal to the checker).
#pragma once

#include "lang/check/names/check_names.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cascade::checking {

/// Reports a cycle of values at one of the formulas in the cycle. `from_system[i]` says whether
/// formula i is a default of the system. If possible, the error is reported at a formula that is
/// not a default, because the author of the stage wrote that formula.
void report_item_cycle(Workspace& work, const System& system,
                       const std::vector<const Formula*>& items,
                       const std::vector<bool>& from_system,
                       const std::vector<std::uint32_t>& cycle);

/// Reports cycles of defaults. A cycle is an error of system `index` even if stages override the
/// defaults.
void report_cycles_of_defaults(Workspace& work, SystemId index);

/// Orders the definitions of system `index` topologically, and finds the order of the system's
/// rates. Reports cycles, and operators that are nested too deeply.
void order_steps(Workspace& work, SystemId index);

}  // namespace cascade::checking
