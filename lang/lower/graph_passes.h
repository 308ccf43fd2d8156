// The passes of lowering, each of which turns one expression graph into another (internal to
// lowering).
//
// lower_expressions.cpp has the list. After the last pass a graph contains only cells, planes and
// links: the effects of a surface, a model or a mask on operators are written out.
#pragma once

#include "lang/program/flatten.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade::lowering {

/// The expressions of a plan between passes.
struct Expressions {
    ExpressionGraph graph;
    std::vector<NodeId> roots;  ///< The requested values.
    std::vector<Origin> origins;
    /// The names of definitions and rates; the first name of a node counts.
    std::vector<std::pair<NodeId, std::string>> names;
    /// The definitions that have sides of their own, by their number in Stage::definition_sides.
    std::vector<std::pair<NodeId, std::size_t>> walls;
};

/// The cells to which expressions apply.
enum class Extent : std::uint8_t {
    domain,  ///< Those inside the mask, if there is one.
    grid,    ///< All, even with a mask.
};

/// Further arguments of passes.
struct PassContext {
    const Program& program;
    std::uint32_t stage = 0;
    Extent extent = Extent::domain;
    bool has_fewer_roundings = false;  ///< Of steps with --fast.
    bool is_start = false;             ///< Of starting values, before there are values at borders.

    /// Do the cells crawl?
    bool is_tissue() const {
        return extent == Extent::domain && program.system_of(stage).cells.has_value();
    }
    bool has_metric() const {
        return program.domain.surface && program.domain.surface->has_metric && !is_tissue();
    }
    /// Do cells read neighbours over links?
    bool has_links() const { return program.domain.model || is_tissue(); }
    /// Are there cells of the grid outside of the domain?
    bool has_mask() const {
        return program.domain.mask && extent == Extent::domain && !is_tissue();
    }
    /// Has something values, slopes or fluxes at the border of the mask?
    bool has_values_at_border() const;
    /// The grid of the cells; of cells that crawl one whose size does not matter.
    const Grid& grid() const;
};

/// That of a stage's starting values, and of its steps.
PassContext context_of_start(const Program& program, std::uint32_t stage);
PassContext context_of_steps(const Program& program, std::uint32_t stage);

/// A pass goes through the nodes that roots need, operands first, and replaces each by nodes of a
/// new graph.
class GraphPass {
public:
    GraphPass(const Expressions& from, const PassContext& context)
        : from_(from), context_(context) {}
    virtual ~GraphPass() = default;

    Expressions run();

protected:
    /// Replaces a node whose operands are nodes of the new graph already.
    virtual NodeId image_of(const Node& node) = 0;
    /// Copies the node, with the place where it was written.
    NodeId keep(const Node& node) { return graph().add(node, from_.graph.written(at_)); }

    ExpressionGraph& graph() { return to_.graph; }
    const PassContext& context() const { return context_; }
    /// The node of the old graph that is being replaced.
    NodeId at() const { return at_; }
    const ExpressionGraph& old() const { return from_.graph; }
    NodeId image(NodeId old) const { return images_[old]; }

    Term term(NodeId id) { return {&graph(), id}; }
    Term leaf(const NodeKind& kind) { return term(graph().leaf(kind)); }

private:
    const Expressions& from_;
    PassContext context_;
    Expressions to_;
    NodeId at_;
    IdVector<NodeId, NodeId> images_;
};

// The passes, in order; see lower_expressions.cpp.
Expressions lay_on_tissue(const Expressions& from, const PassContext& context);
Expressions write_out_tensors(const Expressions& from, const PassContext& context);
Expressions lay_on_surface(const Expressions& from, const PassContext& context);
Expressions write_out_stencils(const Expressions& from, const PassContext& context);
Expressions write_out_limiters(const Expressions& from, const PassContext& context);
Expressions find_beyond_border(const Expressions& from, const PassContext& context);
Expressions spread_over_links(const Expressions& from, const PassContext& context);
Expressions take_out_even_weights(const Expressions& from, const PassContext& context);
Expressions weigh_by_areas(const Expressions& from, const PassContext& context);
Expressions leave_out_masked_cells(const Expressions& from, const PassContext& context);
Expressions fuse_products(const Expressions& from, const PassContext& context);

/// Finds the nodes that are the same in all cells.
IdVector<NodeId, bool> uniform_nodes(const ExpressionGraph& graph, const PassContext& context);

/// Turns `value`, a derivative along the outward unit normal of a side, into the difference between
/// the cells on both sides of it. Off surfaces that is `value` itself; on a surface it depends on
/// the length of the cell, too. Rows and columns must meet at right angles there.
NodeId across_side(ExpressionGraph& graph, const PassContext& context, NodeId value, Side side);

}  // namespace cascade::lowering
