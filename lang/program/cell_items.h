// The items and rules that only systems of crawling cells have. For other systems, the functions
// return false or an empty list.
#pragma once

#include "lang/program/system.h"

#include <vector>

namespace cascade {

/// Whether the item is a component of the position or of the frame. Scripts cannot name these
/// components.
inline bool is_component(const System& system, ItemId item) {
    return system.cells && system.cells->has_component(item);
}
inline bool is_component_of_frame(const System& system, ItemId item) {
    return is_component(system, item) && item >= system.cells->frame;
}
inline bool is_component_of_place(const System& system, ItemId item) {
    return is_component(system, item) && item < system.cells->frame;
}

/// The formulas that rules_of(const CellRules&) returns. Empty for systems of fields.
inline std::vector<const Formula*> rules_of(const System& system) {
    return system.cells ? rules_of(*system.cells) : std::vector<const Formula*>();
}

}  // namespace cascade
