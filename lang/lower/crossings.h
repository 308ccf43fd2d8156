// Facts about vectors at faces: which fluxes cross the sides of the grid, and the entries of
// tensors. Used by lowering and by continuation/.
#pragma once

#include "lang/lower/plan_graph.h"

#include <array>

namespace cascade::lowering {

/// Facts about a flux through the sides of the grid.
struct Crossing {
    /// Whether the flux may differ from 0 even if all fields are mirrored.
    bool goes_across = false;
    bool has_species = false;
    /// For each side, whether the flux reads a species that is not mirrored there.
    std::array<bool, wall_count> is_open{};
};

/// The facts about each node of a graph. If all species of a flux are mirrored at a side, or at the
/// border of a mask, nothing flows through: differences across it are 0 by themselves, and other
/// vectors, or components that a tensor turns towards it, are set to 0 there.
IdVector<NodeId, Crossing> crossings_of(const PlanGraph& graph);

/// The number of rows of a tensor. The operands of the node are the tensor's entries.
int tensor_size(const Node& tensor);
/// The number of the operand that is the entry in this row and column, for a tensor with `size`
/// rows. The operands are a11, a12, a22, or a11, a12, a13, a22, a23, a33.
std::size_t tensor_entry(int size, int row, int column);

}  // namespace cascade::lowering
