// Readers first for where parts are needed, operands first for the network of costs, readers first
// again for what has to be known in a step.
#include "lang/lower/step_invariants.h"

#include "lang/lower/minimum_cut.h"
#include "lang/lower/pass_planner.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace cascade::lowering {

namespace {

bool is_aggregate(const Part& part) {
    return part.node.kind == NodeKind::call && info(part.node.function).is_aggregate;
}

/// Does it take operations of each cell that a plane could save?
bool is_costly(const PartGraph& graph, PartId id) {
    return graph[id].is_step_invariant && !graph[id].is_uniform && !graph.is_plane(id);
}

template <typename Visit>
void for_each_operand(const Part& part, const Visit& visit) {
    for (std::uint32_t k = 0; k < part.operand_count; ++k) visit(part.operands[k]);
}

/// The parts for which is_chosen(part) holds that can be reached by parts for which it does not.
template <typename Chosen>
std::vector<PartId> first_reached(const PartGraph& graph, std::span<const PartId> roots,
                                  const Chosen& is_chosen) {
    std::vector<bool> needed(graph.size(), false);
    std::vector<PartId> parts;
    for (const PartId root : roots) needed[root] = true;
    for (PartId id = static_cast<PartId>(graph.size()); id-- > 0;) {
        if (!needed[id]) continue;
        if (is_chosen(id)) {
            parts.push_back(id);
        } else {
            for_each_operand(graph[id], [&](PartId operand) { needed[operand] = true; });
        }
    }
    std::reverse(parts.begin(), parts.end());
    return parts;
}

class Chooser {
public:
    Chooser(const PartGraph& graph, std::span<const PartId> roots)
        : graph_(graph),
          roots_(roots),
          axes_(graph.program().domain.grid),
          places_(graph.size(), 0),
          number_(graph.size(), 0) {}

    std::vector<PartId> choose() {
        for (const PartId root : roots_) places_[root] = 1;
        for (PartId id = static_cast<PartId>(graph_.size()); id-- > 0;) {
            if (places_[id] > 0) need_operands(id);
        }
        for (PartId id = 0; id < graph_.size(); ++id) {
            if (places_[id] > 0 && is_costly(graph_, id)) add_to_network(id);
        }
        for (const PartId root : roots_) want(root);
        for (PartId id = 0; id < graph_.size(); ++id) {
            if (places_[id] == 0 || graph_[id].is_step_invariant) continue;
            for_each_operand(graph_[id], [&](PartId operand) { want(operand); });
        }
        return first_reached(graph_, roots_, [&](PartId id) {
            const bool is_number = graph_[id].is_step_invariant && is_aggregate(graph_[id]);
            return is_number || (is_costly(graph_, id) && cut_.is_kept(number_[id]));
        });
    }

private:
    /// An operator along an axis of one cell reads nothing, but its operand is a part all the same.
    void need(PartId id, std::uint32_t places) {
        places_[id] = std::max({places_[id], places, std::uint32_t{1}});
    }

    /// A part that is computed in every step needs its operands in the own cell, or around it.
    void need_operands(PartId id) {
        const Part& part = graph_[id];
        const bool is_operator = part.node.kind == NodeKind::call && !part.is_uniform;
        const bool at_faces = is_operator && part.node.type == ValueType::vector;
        for (std::uint32_t k = 0; k < part.operand_count; ++k) {
            // What lasts is computed wherever its reader is.
            std::uint32_t places = part.is_step_invariant ? places_[id] : 1;
            if (at_faces) {
                places = count(axes_.crosswise());
            } else if (is_operator && is_stencil(part.node.function) &&
                       k + 1 == part.operand_count) {
                places = count(stencil_offsets(part, axes_));
            }
            need(part.operands[k], places);
        }
    }

    static std::uint32_t count(Offsets offsets) {
        return static_cast<std::uint32_t>(std::popcount(offsets));
    }

    void add_to_network(PartId id) {
        const Part& part = graph_[id];
        const bool can_be_kept = part.node.type == ValueType::number && !part.is_open();
        std::vector<std::uint32_t> operands;
        for_each_operand(graph_[id], [&](PartId operand) {
            if (is_costly(graph_, operand)) operands.push_back(number_[operand]);
        });
        number_[id] = cut_.add(can_be_kept ? operations_of_reading : MinimumCut::unlimited,
                               operations_of(part) * places_[id], operands);
    }

    void want(PartId id) {
        if (is_costly(graph_, id)) cut_.want(number_[id]);
    }

    const PartGraph& graph_;
    std::span<const PartId> roots_;
    Axes axes_;
    MinimumCut cut_;
    std::vector<std::uint32_t> places_;  ///< At how many cells a part is needed, about; 0: nowhere.
    std::vector<std::uint32_t> number_;  ///< In the network, of costly parts.
};

}  // namespace

std::vector<PartId> step_invariant_parts(const PartGraph& graph, std::span<const PartId> roots) {
    return Chooser(graph, roots).choose();
}

std::vector<PartId> largest_step_invariants(const PartGraph& graph, std::span<const PartId> roots) {
    return first_reached(graph, roots, [&](PartId id) {
        const Part& part = graph[id];
        if (!part.is_step_invariant || part.node.type != ValueType::number) return false;
        return is_aggregate(part) || is_costly(graph, id);
    });
}

}  // namespace cascade::lowering
