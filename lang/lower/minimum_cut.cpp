// Increases the flow from one needed part after another until it is maximal. If a search fails, the
// nodes that it reached do not lead to the sink. Later flows cannot enter these nodes, so the nodes
// never lead to the sink, and no search visits them again.
#include "lang/lower/minimum_cut.h"

#include <algorithm>

namespace cascade::lowering {

void MinimumCut::join(std::uint32_t from, std::uint32_t to, std::int64_t capacity) {
    edges_of_[from].push_back(static_cast<std::uint32_t>(edges_.size()));
    edges_.push_back({to, capacity});
    edges_of_[to].push_back(static_cast<std::uint32_t>(edges_.size()));
    edges_.push_back({from, 0});
}

std::uint32_t MinimumCut::add(std::int64_t reading, std::int64_t operations,
                              std::span<const std::uint32_t> operands) {
    const auto part = static_cast<std::uint32_t>(edges_of_.size() / 2);
    edges_of_.resize(edges_of_.size() + 2);
    is_reached_.resize(edges_of_.size(), false);
    to_sink_.push_back(0);
    to_sink_.push_back(operations);
    join(wanted(part), computed(part), reading);
    for (const std::uint32_t operand : operands) join(computed(part), wanted(operand), unlimited);
    return part;
}

void MinimumCut::want(std::uint32_t part) {
    if (is_reached_[wanted(part)]) return;
    while (augment(wanted(part))) {
    }
}

/// Increases the flow from a node to the sink. If this is impossible, returns false and marks all
/// nodes that can be reached from the node.
bool MinimumCut::augment(std::uint32_t from) {
    std::vector<bool> seen(edges_of_.size(), false);
    std::vector<std::uint32_t> came_by(edges_of_.size());
    std::vector<std::uint32_t> open{from}, reached{from};
    seen[from] = true;
    while (!open.empty()) {
        const std::uint32_t node = open.back();
        open.pop_back();
        if (to_sink_[node] > 0) {
            std::int64_t flow = to_sink_[node];
            for (std::uint32_t at = node; at != from; at = edges_[came_by[at] ^ 1].to) {
                flow = std::min(flow, edges_[came_by[at]].left);
            }
            to_sink_[node] -= flow;
            for (std::uint32_t at = node; at != from; at = edges_[came_by[at] ^ 1].to) {
                edges_[came_by[at]].left -= flow;
                edges_[came_by[at] ^ 1].left += flow;
            }
            return true;
        }
        for (const std::uint32_t number : edges_of_[node]) {
            const Edge& edge = edges_[number];
            if (edge.left == 0 || seen[edge.to] || is_reached_[edge.to]) continue;
            seen[edge.to] = true;
            came_by[edge.to] = number;
            open.push_back(edge.to);
            reached.push_back(edge.to);
        }
    }
    for (const std::uint32_t node : reached) is_reached_[node] = true;
    return false;
}

}  // namespace cascade::lowering
