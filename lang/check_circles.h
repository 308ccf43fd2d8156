// Orders of computation and circles in them (internal to the checker and the lowering).
#pragma once

#include "lang/check_names.h"
#include "lang/order.h"

namespace cascade {

/// What a system's definitions and rates read of each other: number d is definition d, number
/// `definitions.size() + item` the rate of an item.
Dependencies step_dependencies(const System& system);

namespace checking {

/// What the items of a stage (or the defaults of a system) read of each other.
Dependencies item_dependencies(const std::vector<const Formula*>& items);

/// Reports a circle of values at the place in `items` where it is read; `from_system[i]` tells
/// which formulas are defaults, whose places are of less use to the reader.
void report_item_circle(Workspace& work, const System& system,
                        const std::vector<const Formula*>& items,
                        const std::vector<bool>& from_system,
                        const std::vector<std::uint32_t>& circle);

/// Reports a circle of definitions and rates.
void report_step_circle(Workspace& work, const System& system,
                        const std::vector<std::uint32_t>& circle);

}  // namespace checking

}  // namespace cascade
