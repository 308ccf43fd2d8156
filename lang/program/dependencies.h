// Lists the values that each value of a system reads (internal to lang/).
#pragma once

#include "lang/program/order.h"
#include "lang/program/program.h"

#include <vector>

namespace cascade {

/// For each definition and rate of a system, the definitions and rates that it reads. Definition d
/// has the number d. The rate of item i has the number `definitions.size() + i`.
Dependencies step_dependencies(const System& system);

/// For each item of a stage, or for each default of a system, the items that its formula reads. An
/// item whose pointer is null has no formula and reads nothing.
Dependencies item_dependencies(const std::vector<const Formula*>& items);

/// The items of a stage that need an aggregate over the domain, directly or through other items.
/// They can be computed only after the cells have been made.
IdVector<ItemId, bool> items_of_aggregates(const Stage& stage);

}  // namespace cascade
