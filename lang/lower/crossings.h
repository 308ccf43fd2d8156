// Facts about vectors at faces: which fluxes cross the sides of the grid, and the entries of
// tensors. For lowering and for the folder continuation/.
#pragma once

#include "lang/lower/plan_graph.h"

#include <array>

namespace cascade::lowering {

/// Facts about a flux through the sides of the grid.
struct Crossing {
    bool goes_across = false;  ///< Whether the flux may differ from 0 even if all fields are
                               ///< mirrored.
    bool has_species = false;
    std::array<bool, wall_count> is_open{};  ///< For each side, whether the flux reads a species
                                             ///< that is not mirrored there.
};

/// The facts about each node of a graph. Nothing flows through a side, or the border of a mask, at
/// which all species of a flux are mirrored. Differences across such a side are 0 by themselves.
/// Other vectors, and components that a tensor turns towards such a side, are set to 0 at the side.
IdVector<NodeId, Crossing> crossings_of(const PlanGraph& graph);

/// The number of rows of a tensor. The operands of the node are the tensor's entries.
int tensor_size(const Node& tensor);
/// The operand of a tensor with `size` rows that is the entry in this row and column. The operands
/// are a11, a12, a22, or a11, a12, a13, a22, a23, a33.
std::size_t tensor_entry(int size, int row, int column);

}  // namespace cascade::lowering
