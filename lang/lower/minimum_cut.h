// What to compute in every step and what once, as a minimum cut (internal to lowering).
//
// A part that is wanted in every step is either kept, which costs reading its plane, or computed,
// which costs its operations and wants its operands. This is a network: from each wanted part an
// edge of capacity `reading` leads to its computing, from there one of capacity `operations` to the
// sink and unlimited ones to its operands. The cheapest choice cuts the least capacity; cut edges
// of the first kind are parts to keep. The greatest flow finds it (L. R. Ford, D. R. Fulkerson,
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

    /// Adds a part and returns its number, counted from 0. Its operands were added before it.
    std::uint32_t add(std::int64_t reading, std::int64_t operations,
                      std::span<const std::uint32_t> operands);
    /// The part is needed in every step.
    void want(std::uint32_t part);
    /// Is it to be kept? Asked when all parts are wanted that are.
    bool is_kept(std::uint32_t part) const {
        return is_reached_[wanted(part)] && !is_reached_[computed(part)];
    }

private:
    struct Edge {
        std::uint32_t to = 0;
        std::int64_t left = 0;  ///< Capacity that no flow takes. The edge back is number ^ 1.
    };

    // Every part is two nodes.
    static std::uint32_t wanted(std::uint32_t part) { return 2 * part; }
    static std::uint32_t computed(std::uint32_t part) { return 2 * part + 1; }

    void join(std::uint32_t from, std::uint32_t to, std::int64_t capacity);
    bool augment(std::uint32_t from);

    std::vector<Edge> edges_;
    std::vector<std::vector<std::uint32_t>> edges_of_;  ///< By node.
    std::vector<std::int64_t> to_sink_;                 ///< By node: capacity that is left.
    /// By node: reached from a wanted part by edges with capacity left, once no more can flow.
    std::vector<bool> is_reached_;
};

}  // namespace cascade::lowering
