// Which values of a system read which (internal to lang/).
#pragma once

#include "lang/program/order.h"
#include "lang/program/program.h"

#include <vector>

namespace cascade {

/// Which definitions and rates of a system read each other: number d is definition d, and
/// `definitions.size() + item` is the rate of an item.
Dependencies step_dependencies(const System& system);

/// Which items of a stage (or defaults of a system) read each other. An item without a formula
/// (nullptr) reads nothing.
Dependencies item_dependencies(const std::vector<const Formula*>& items);

/// The items of a stage that need an aggregate over the domain, directly or through others, so that
/// they can only be computed when there are cells.
IdVector<ItemId, bool> items_of_aggregates(const Stage& stage);

}  // namespace cascade
