// Vectors, frames and links of cells that crawl as numbers of an expression graph (internal to
// lowering).
#pragma once

#include "lang/lower/graph_passes.h"
#include "lang/program/terms.h"

#include <cstddef>

namespace cascade::lowering {

/// Adds nodes to a graph of a stage of cells that crawl.
class TissueNumbers {
public:
    TissueNumbers(ExpressionGraph& graph, const PassContext& context)
        : graph_(graph),
          context_(context),
          rules_(*context.program.system_of(context.stage).cells) {}

    Term term(NodeId id) { return {&graph_, id}; }
    Term leaf(const NodeKind& kind) { return term(graph_.leaf(kind)); }
    /// Three items that follow each other.
    TermVector items(ItemId first);
    TermVector place() { return items(rules_.place); }
    /// An axis of the cell's frame: 0 is ex, 1 ey, 2 ez.
    TermVector axis(std::size_t axis);

    // Of a link.
    /// The value of a plane at the other end; a number is the same there.
    Term theirs(Term plane);
    /// From the cell to its neighbour, on periodic planes to the nearest image of it.
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
