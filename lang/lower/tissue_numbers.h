// Expresses vectors, frames and links of crawling cells by numbers in an expression graph (internal
// to lowering).
#pragma once

#include "lang/lower/graph_passes.h"
#include "lang/program/terms.h"

#include <cstddef>

namespace cascade::lowering {

/// Adds nodes to the graph of a stage of crawling cells.
class TissueNumbers {
public:
    TissueNumbers(ExpressionGraph& graph, const PassContext& context)
        : graph_(graph),
          context_(context),
          rules_(*context.program.system_of(context.stage).cells) {}

    Term term(NodeId id) { return {&graph_, id}; }
    Term leaf(const NodeKind& kind) { return term(graph_.leaf(kind)); }
    /// The vector whose components are three consecutive items.
    TermVector items(ItemId first);
    TermVector place() { return items(rules_.place); }
    /// An axis of the cell's frame: 0 is ex, 1 ey, 2 ez.
    TermVector axis(std::size_t axis);

    // The following functions return values that belong to a link.

    /// The value of a plane at the other end of the link. If the operand is a number and not a
    /// plane, the value is the same at both ends.
    Term theirs(Term plane);
    /// The vector from the cell to its neighbour. On a periodic plane, the vector leads to the
    /// nearest image of the neighbour.
    TermVector apart();
    Term distance() { return length(apart()); }
    TermVector direction() { return unit(apart()); }
    Term gap() { return distance() - radii(); }
    Term overlap() { return max(-gap(), leaf(0.0)); }
    Term contact();
    Term is_touching() { return distance() < leaf(rules_.reach) * radii(); }

private:
    Term radii();

    ExpressionGraph& graph_;
    const PassContext context_;
    const CellRules& rules_;
};

}  // namespace cascade::lowering
