// The order of values that depend on each other, and cycles (internal to the checker).
#pragma once

#include "lang/check/names/check_names.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cascade::checking {

/// Reports a cycle of values at a formula of `items` that closes it. `from_system[i]` is true for
/// defaults; the places of other formulas are preferred, since the stage's author wrote them.
void report_item_cycle(Workspace& work, const System& system,
                       const std::vector<const Formula*>& items,
                       const std::vector<bool>& from_system,
                       const std::vector<std::uint32_t>& cycle);

/// Reports cycles of defaults, which are errors of system `index` even if its stages override them.
void report_cycles_of_defaults(Workspace& work, SystemId index);

/// Orders the definitions of system `index` topologically, finds the order of its rates, and
/// reports cycles and operators that are nested too deeply.
void order_steps(Workspace& work, SystemId index);

}  // namespace cascade::checking
