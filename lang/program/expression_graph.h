// A graph of expressions. Equal expressions are the same node (hash-consing), and operands come
// before the nodes that read them.
//
// Calculus and lowering put all formulas of a system into one graph. Calculus simplifies the
// formulas while it builds the graph (lang/calculus/algebra.h). The passes of lowering turn one
// graph into another (lang/lower/graph_passes.h).
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// Where a node was written: the number of the formula, and the node's position in this formula.
struct Written {
    static constexpr std::uint32_t nowhere = UINT32_MAX;
    /// `nowhere` for nodes that are not in the script, such as nodes of derivatives.
    std::uint32_t formula = nowhere;
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

    /// The node that equals `node`, or a new node. The operands must be nodes of this graph. Two
    /// draws of random numbers are equal if they were written at the same place.
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
    /// The value of a sum, difference, product or quotient if the value is known because an operand
    /// is 0; otherwise nullopt.
    std::optional<NodeId> without_zeros(Function function, NodeId a, NodeId b);
    bool is_number(NodeId id) const { return nodes_[id].is<double>(); }
    bool is_number(NodeId id, double value) const { return nodes_[id].is(value); }

private:
    void make_room();

    Nodes nodes_;
    IdVector<NodeId, Written> written_;
    /// A hash table of all nodes. The number of its entries is a power of two, and entries may be
    /// empty.
    std::vector<std::optional<NodeId>> known_;
};

/// For each node, whether it is one of `roots` or is needed to compute any of `roots`.
IdVector<NodeId, bool> needed_by(const ExpressionGraph& graph, std::span<const NodeId> roots);

}  // namespace cascade
