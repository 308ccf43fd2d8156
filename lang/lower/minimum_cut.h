// Decides which parts of formulas to compute in every step and which only once. The decision is a
// minimum cut (internal to lowering).
//
// A part that is needed in every step is either kept (computed once and then read from a plane) or
// computed again in every step. Keeping a part costs the time to read its plane. Computing a part
// costs the time of its operations, and its operands are then needed, too. In the network, an edge
// of capacity `reading` leads from each needed part to its computation. From the computation, an
// edge of capacity `operations` leads to the sink, and edges of unlimited capacity lead to the
// operands. The cheapest choice is the minimum cut: a part is kept if the edge to its computation
// is cut. The maximum flow gives this cut (L. R. Ford, D. R. Fulkerson, "Maximal flow through a
// network", Canadian Journal of Mathematics 8, 1956, 399-404).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace cascade::lowering {

class MinimumCut {
public:
    /// Larger than any sum of costs.
    static constexpr std::int64_t unlimited = std::int64_t{1} << 40;

    /// Adds a part and returns its index. The part's operands must have been added before.
    std::uint32_t add(std::int64_t reading, std::int64_t operations,
                      std::span<const std::uint32_t> operands);
    /// Marks a part as needed in every step.
    void want(std::uint32_t part);
    /// Whether the part should be kept. May be called only when all needed parts have been marked.
    bool is_kept(std::uint32_t part) const {
        return is_reached_[wanted(part)] && !is_reached_[computed(part)];
    }

private:
    struct Edge {
        std::uint32_t to = 0;
        std::int64_t left = 0;  ///< The capacity that remains. The reverse of edge n is edge n ^ 1.
    };

    // Every part has two nodes in the network: one for the need of the part, and one for its
    // computation.
    static std::uint32_t wanted(std::uint32_t part) { return 2 * part; }
    static std::uint32_t computed(std::uint32_t part) { return 2 * part + 1; }

    void join(std::uint32_t from, std::uint32_t to, std::int64_t capacity);
    bool augment(std::uint32_t from);

    std::vector<Edge> edges_;
    std::vector<std::vector<std::uint32_t>> edges_of_;  ///< The edges of each node.
    std::vector<std::int64_t> to_sink_;  ///< For each node, the capacity that remains to the sink.
    /// For each node, whether edges with remaining capacity lead to it from a needed part. Known
    /// once the flow is maximal.
    std::vector<bool> is_reached_;
};

}  // namespace cascade::lowering
