// Cycles: values that read each other (internal to the checker).
#pragma once

#include "lang/check/check_names.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cascade::checking {

/// "a -> b -> a". Of a long cycle only the first members are named.
std::string describe_cycle(const std::vector<std::string>& names);

/// Reports a cycle of values at the place in `items` where it is read; `from_system[i]` tells
/// which formulas are defaults, whose places are of less use to the reader.
void report_item_cycle(Workspace& work, const System& system,
                       const std::vector<const Formula*>& items,
                       const std::vector<bool>& from_system,
                       const std::vector<std::uint32_t>& cycle);

/// Reports a cycle of definitions and rates.
void report_step_cycle(Workspace& work, const System& system,
                       const std::vector<std::uint32_t>& cycle);

}  // namespace cascade::checking
