// Expressions as one graph: equal expressions are one node (hash-consing), and operands come before
// their readers.
//
// Code that works on all formulas of a system works on such a graph: calculus, which simplifies
// while it builds (lang/calculus/algebra.h), and the passes of lowering, which turn one graph into
// another (lang/lower/graph_passes.h).
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// Where a node was written: the formula, and the place in it.
struct Written {
    static constexpr std::uint32_t nowhere = UINT32_MAX;
    std::uint32_t formula = nowhere;  ///< `nowhere` for nodes that a rule has made.
    NodeId position;

    friend bool operator==(const Written&, const Written&) = default;
};

class ExpressionGraph {
public:
    ExpressionGraph() = default;
    ExpressionGraph(const ExpressionGraph&) = default;
    ExpressionGraph(ExpressionGraph&&) = default;
    ExpressionGraph& operator=(const ExpressionGraph&) = default;
    ExpressionGraph& operator=(ExpressionGraph&&) = default;
    virtual ~ExpressionGraph() = default;

    /// The node that equals this one, or a new one. Its operands are nodes of this graph. Draws of
    /// random numbers are equal if they were written in the same place.
    NodeId add(const Node& node, Written written = {});
    NodeId number(double value) { return leaf(value); }
    /// A node without operands.
    NodeId leaf(const NodeKind& kind);
    virtual NodeId call(Function function, std::initializer_list<NodeId> operands,
                        ValueType type = ValueType::number);

    const Node& operator[](NodeId id) const { return nodes_[id]; }
    const Nodes& nodes() const { return nodes_; }
    std::size_t size() const { return nodes_.size(); }
    Written written(NodeId id) const { return written_[id]; }
    /// The value of a sum, difference, product or quotient if an operand that is known to be 0 says
    /// it.
    std::optional<NodeId> without_zeros(Function function, NodeId a, NodeId b);
    bool is_number(NodeId id) const { return nodes_[id].is<double>(); }
    bool is_number(NodeId id, double value) const { return nodes_[id].is(value); }

private:
    void make_room();

    Nodes nodes_;
    IdVector<NodeId, Written> written_;
    /// The slot of a node in the hash table, whose size is a power of two, or the next free slot.
    std::vector<std::optional<NodeId>> known_;
};

/// The nodes that a list of them needs, directly or through others, themselves included.
IdVector<NodeId, bool> needed_by(const ExpressionGraph& graph, std::span<const NodeId> roots);

}  // namespace cascade
