// Lists the values that each value of a system reads (internal to lang/).
#pragma once

#include "lang/program/order.h"
#include "lang/program/program.h"

#include <vector>

namespace cascade {

/// For each definition and rate of a system, the definitions and rates that it reads. Number d is
/// definition d. Number `definitions.size() + item` is the rate of an item.
Dependencies step_dependencies(const System& system);

/// For each item of a stage, or each default of a system, the items that it reads. An item without
/// a formula (null) reads nothing.
Dependencies item_dependencies(const std::vector<const Formula*>& items);

/// The items of a stage that need an aggregate over the domain, directly or through other items.
/// They can be computed only after the cells have been made.
IdVector<ItemId, bool> items_of_aggregates(const Stage& stage);

}  // namespace cascade
