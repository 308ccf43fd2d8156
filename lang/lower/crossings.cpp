// Finds the facts about each node from the facts about its operands.
#include "lang/lower/crossings.h"

namespace cascade::lowering {

IdVector<NodeId, Crossing> crossings_of(const PlanGraph& graph) {
    const System& system = graph.program().system_of(graph.stage());
    IdVector<ItemId, SideKinds> of_item;
    for (const ItemId item : system.items()) {
        of_item.push_back(side_kinds(graph.program(), graph.stage(), item));
    }
    IdVector<NodeId, Crossing> crossings(graph.size());
    for (const NodeId id : graph.ids()) {
        const Node& node = graph[id];
        Crossing& crossing = crossings[id];
        const bool is_vector = node.type == ValueType::vector;
        crossing.goes_across = is_vector && node.calls(Function::vector);
        if (const auto* item = node.as<ItemId>(); item != nullptr && system.is_species(*item)) {
            crossing.has_species = true;
            for (std::size_t side = 0; side < side_count; ++side) {
                crossing.is_open[side] = of_item[*item][side] != SideKind::no_flux;
            }
        }
        const DefinitionSides* own = graph.sides(id);
        for (std::size_t side = 0; own != nullptr && side < side_count; ++side) {
            crossing.has_species = true;
            crossing.is_open[side] = own->sides[side].kind != SideKind::no_flux;
        }
        if (node.calls(Function::bordered)) {
            crossing = crossings[node.operands[0]];
            crossing.is_open[static_cast<std::size_t>(Side::border)] = true;
            continue;
        }
        for (const NodeId read : node.reads()) {
            if (own != nullptr) break;
            const Crossing& operand = crossings[read];
            const bool turns = graph[read].type == ValueType::tensor;
            crossing.goes_across |= is_vector && (operand.goes_across || turns);
            crossing.has_species |= operand.has_species;
            for (std::size_t side = 0; side < wall_count; ++side) {
                crossing.is_open[side] |= operand.is_open[side];
            }
        }
    }
    return crossings;
}

int tensor_size(const Node& tensor) { return tensor.operand_count == 6 ? 3 : 2; }

std::size_t tensor_entry(int size, int row, int column) {
    constexpr std::array<std::array<std::size_t, 3>, 3> in_space{{{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};
    if (size == 2) return static_cast<std::size_t>(row + column);
    return in_space[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
}

}  // namespace cascade::lowering
