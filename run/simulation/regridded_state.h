// A stage's state on another grid (internal to run/simulation).
#pragma once

#include "run/stage/stage_state.h"

#include <cstddef>
#include <functional>
#include <memory>

namespace cascade {

/// How planes and the values of sides become those of the other grid.
struct Regridding {
    double spacing = 1;  ///< Of the other grid.
    /// Called for planes that are not empty.
    std::function<Field(const Field& plane)> plane;
    /// Called for sides that have values. `side` is their number.
    std::function<std::shared_ptr<const SideValues>(const SideValues& values, std::size_t side)>
        values;
};

/// The state without what only steps need: its moment, numbers, planes and sides, and not `frozen`.
StageState regridded(const StageState& state, const Regridding& regridding);

/// The item `frozen` of a stage of fields, whose last items are `frozen` and `speed`.
inline ItemId frozen_item(const StageState& state) { return ItemId(state.fields.size() - 2); }

}  // namespace cascade
