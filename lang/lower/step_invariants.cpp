// Walks over the graph three times. The first walk visits readers before operands and finds how
// many cells need each node. The second walk visits operands before readers and builds the network
// of costs (minimum_cut.h). The third walk visits readers before operands and finds the values that
// a step needs.
#include "lang/lower/step_invariants.h"

#include "lang/lower/minimum_cut.h"
#include "lang/lower/pass_planner.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace cascade::lowering {

namespace {

bool has_tensor_weights(const PlanGraph& graph, NodeId id) {
    return graph[id].calls(Function::tensor_weights);
}

/// Whether computing the node takes operations in each cell that reading a plane would save.
bool is_costly(const PlanGraph& graph, NodeId id) {
    return graph.is_step_invariant(id) && !graph.is_uniform(id) && !graph.is_plane(id) &&
           !has_tensor_weights(graph, id);
}

/// The first node for which is_chosen(node) holds on each path from a root to operands, operands of
/// operands, and so on.
template <typename Chosen>
std::vector<NodeId> first_reached(const PlanGraph& graph, std::span<const NodeId> roots,
                                  const Chosen& is_chosen) {
    IdVector<NodeId, bool> needed(graph.size(), false);
    std::vector<NodeId> nodes;
    for (const NodeId root : roots) needed[root] = true;
    for (const NodeId id : graph.ids_backwards()) {
        if (!needed[id]) continue;
        if (is_chosen(id)) {
            nodes.push_back(id);
        } else if (!has_tensor_weights(graph, id)) {
            for (const NodeId operand : operands_of(graph[id])) needed[operand] = true;
        }
    }
    std::reverse(nodes.begin(), nodes.end());
    return nodes;
}

class Chooser {
public:
    Chooser(const PlanGraph& graph, std::span<const NodeId> roots)
        : graph_(graph),
          roots_(roots),
          axes_(graph.grid().stencil()),
          places_(graph.size(), 0),
          number_(graph.size(), 0) {}

    std::vector<NodeId> choose() {
        for (const NodeId root : roots_) places_[root] = 1;
        for (const NodeId id : graph_.ids_backwards()) {
            if (places_[id] > 0) need_operands(id);
        }
        for (const NodeId id : graph_.ids()) {
            if (places_[id] > 0 && is_costly(graph_, id)) add_to_network(id);
        }
        for (const NodeId root : roots_) want(root);
        for (const NodeId id : graph_.ids()) {
            if (places_[id] == 0 || graph_.is_step_invariant(id)) continue;
            for (const NodeId operand : operands_of(graph_[id])) want(operand);
        }
        return first_reached(graph_, roots_, [&](NodeId id) {
            const bool is_number = graph_.is_step_invariant(id) && is_aggregate(graph_[id]);
            return is_number || (is_costly(graph_, id) && cut_.is_kept(number_[id]));
        });
    }

private:
    /// Marks a node as needed at `places` cells, or at one cell if `places` is 0. It is 0 if the
    /// node is the operand of an operator along an axis with one cell, which does not read the
    /// node.
    void need(NodeId id, std::uint32_t places) {
        places_[id] = std::max({places_[id], places, std::uint32_t{1}});
    }

    /// Marks the operands of a node that is computed in every step. The operands are needed in the
    /// cell itself or at its neighbours.
    void need_operands(NodeId id) {
        if (has_tensor_weights(graph_, id)) return;
        const Node& node = graph_[id];
        const bool is_operator = node.is<Call>() && !graph_.is_uniform(id);
        const bool at_faces = is_operator && node.type == ValueType::vector;
        const std::size_t count_of_operands = operands_of(node).size();
        for (std::size_t k = 0; k < count_of_operands; ++k) {
            // A step-invariant operand of a step-invariant node is computed in as many cells as the
            // node.
            std::uint32_t places = graph_.is_step_invariant(id) ? places_[id] : 1;
            if (at_faces) {
                places = count(crosswise(axes_));
            } else if (is_operator && is_stencil(node.function) && k + 1 == node.operand_count) {
                places = count(offsets_of(node, axes_));
            }
            need(node.operands[k], places);
        }
    }

    static std::uint32_t count(Offsets offsets) {
        return static_cast<std::uint32_t>(std::popcount(offsets));
    }

    void add_to_network(NodeId id) {
        const Node& node = graph_[id];
        const bool can_be_kept = node.type == ValueType::number && !graph_.is_open(id);
        std::vector<std::uint32_t> operands;
        for (const NodeId operand : operands_of(node)) {
            if (is_costly(graph_, operand)) operands.push_back(number_[operand]);
        }
        number_[id] = cut_.add(can_be_kept ? operations_of_reading : MinimumCut::unlimited,
                               operations_of(node) * places_[id], operands);
    }

    void want(NodeId id) {
        if (is_costly(graph_, id)) cut_.want(number_[id]);
    }

    const PlanGraph& graph_;
    std::span<const NodeId> roots_;
    GridAxes axes_;
    MinimumCut cut_;
    /// For each node, the approximate number of cells at which it is needed.
    IdVector<NodeId, std::uint32_t> places_;
    IdVector<NodeId, std::uint32_t> number_;  ///< For each costly node, its part in the network.
};

}  // namespace

std::vector<NodeId> step_invariant_nodes(const PlanGraph& graph, std::span<const NodeId> roots) {
    return Chooser(graph, roots).choose();
}

std::vector<NodeId> tensor_weight_nodes(const PlanGraph& graph, std::span<const NodeId> roots) {
    return first_reached(graph, roots, [&](NodeId id) { return has_tensor_weights(graph, id); });
}

std::vector<NodeId> largest_step_invariants(const PlanGraph& graph, std::span<const NodeId> roots) {
    return first_reached(graph, roots, [&](NodeId id) {
        const Node& node = graph[id];
        if (!graph.is_step_invariant(id) || node.type != ValueType::number) return false;
        return is_aggregate(node) || is_costly(graph, id);
    });
}

}  // namespace cascade::lowering
