// Decides what to compute in every step and what once, as a minimum cut (internal to lowering).
//
// A part that is needed in every step is either kept, which costs reading its plane, or computed,
// which costs its operations and needs its operands. In the network, an edge of capacity `reading`
// leads from each needed part to its computation, and from there one edge of capacity `operations`
// to the sink and unlimited ones to its operands. The cheapest choice is the minimum cut; cut edges
// of the first kind are parts to keep. The maximum flow finds it (L. R. Ford, D. R. Fulkerson,
// "Maximal flow through a network", Canadian Journal of Mathematics 8, 1956, 399-404).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace cascade::lowering {

class MinimumCut {
public:
    /// More than any sum of costs.
    static constexpr std::int64_t unlimited = std::int64_t{1} << 40;

    /// Adds a part and returns its number, counted from 0. Its operands must be added first.
    std::uint32_t add(std::int64_t reading, std::int64_t operations,
                      std::span<const std::uint32_t> operands);
    /// Marks the part as needed in every step.
    void want(std::uint32_t part);
    /// Is it to be kept? To be called after all needed parts are marked.
    bool is_kept(std::uint32_t part) const {
        return is_reached_[wanted(part)] && !is_reached_[computed(part)];
    }

private:
    struct Edge {
        std::uint32_t to = 0;
        std::int64_t left = 0;  ///< Capacity that is left. The reverse edge is number ^ 1.
    };

    // Every part is two nodes.
    static std::uint32_t wanted(std::uint32_t part) { return 2 * part; }
    static std::uint32_t computed(std::uint32_t part) { return 2 * part + 1; }

    void join(std::uint32_t from, std::uint32_t to, std::int64_t capacity);
    bool augment(std::uint32_t from);

    std::vector<Edge> edges_;
    std::vector<std::vector<std::uint32_t>> edges_of_;  ///< By node.
    std::vector<std::int64_t> to_sink_;  ///< By node: remaining capacity to the sink.
    /// By node: is it reachable from a needed part by edges with remaining capacity, once the flow
    /// is maximal?
    std::vector<bool> is_reached_;
};

}  // namespace cascade::lowering
