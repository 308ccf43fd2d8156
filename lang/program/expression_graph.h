// A graph of expressions. Equal expressions are the same node (hash-consing), and operands come
// before the nodes that read them.
//
// All formulas of a system are put into one such graph by calculus, which simplifies them while it
// builds the graph (lang/calculus/algebra.h), and by lowering, whose passes turn one graph into
// another (lang/lower/graph_passes.h).
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// The place where a node was written: the formula, and the position in it.
struct Written {
    static constexpr std::uint32_t nowhere = UINT32_MAX;
    std::uint32_t formula = nowhere;  ///< `nowhere` for nodes that are not in the script, such as
                                      ///< nodes of derivatives.
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

    /// The node that equals `node`, or a new node. The operands must be nodes of this graph. Draws
    /// of random numbers are equal if they are written at the same position.
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
    /// The value of a sum, difference, product or quotient, if the value follows from the fact that
    /// an operand is 0.
    std::optional<NodeId> without_zeros(Function function, NodeId a, NodeId b);
    bool is_number(NodeId id) const { return nodes_[id].is<double>(); }
    bool is_number(NodeId id, double value) const { return nodes_[id].is(value); }

private:
    void make_room();

    Nodes nodes_;
    IdVector<NodeId, Written> written_;
    /// A hash table of all nodes. Its size is a power of two, and its entries may be empty.
    std::vector<std::optional<NodeId>> known_;
};

/// For each node, whether it is one of `roots` or is needed to compute one of them.
IdVector<NodeId, bool> needed_by(const ExpressionGraph& graph, std::span<const NodeId> roots);

}  // namespace cascade
