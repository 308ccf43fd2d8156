// Which values of a system read which (internal to lang/).
#pragma once

#include "lang/program/order.h"
#include "lang/program/program.h"

#include <vector>

namespace cascade {

/// What a system's definitions and rates read of each other: number d is definition d, number
/// `definitions.size() + item` the rate of an item.
Dependencies step_dependencies(const System& system);

/// What the items of a stage (or the defaults of a system) read of each other. An item without a
/// formula (nullptr) reads nothing.
Dependencies item_dependencies(const std::vector<const Formula*>& items);

}  // namespace cascade
