// The passes of lowering (internal to lowering). Each pass turns one expression graph into another.
//
// lower_expressions.cpp lists the passes. After the last pass, a graph refers only to cells, planes
// and links. The effects of a surface, a model or a mask on operators have been written out as
// formulas.
#pragma once

#include "lang/program/flatten.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade::lowering {

/// The expressions of a plan, between two passes.
struct Expressions {
    ExpressionGraph graph;
    std::vector<NodeId> roots;  ///< The nodes of the requested values.
    std::vector<Origin> origins;
    /// The names of definitions and rates. If a node has several names, the first name is used.
    std::vector<std::pair<NodeId, std::string>> names;
    /// The definitions that have their own rules at sides. For each, the index of its rules in
    /// Stage::definition_sides.
    std::vector<std::pair<NodeId, std::size_t>> walls;
};

/// The cells in which expressions are computed.
enum class Extent : std::uint8_t {
    domain,  ///< In the cells inside the mask. Without a mask, in all cells.
    grid,    ///< In all cells of the grid, also outside the mask.
};

/// Further arguments of passes.
struct PassContext {
    const Program& program;
    std::uint32_t stage = 0;
    Extent extent = Extent::domain;
    bool has_fewer_roundings = false;  ///< Whether steps use fewer roundings (--fast).
    /// Whether the expressions are starting values, which are computed before values at borders
    /// exist.
    bool is_start = false;
    bool is_step = false;  ///< Whether the expressions are rates. Rates can read step-invariants.

    /// Whether the cells crawl.
    bool is_tissue() const {
        return extent == Extent::domain && program.system_of(stage).cells.has_value();
    }
    bool has_metric() const {
        return program.domain.surface && program.domain.surface->has_metric && !is_tissue();
    }
    /// Whether cells read neighbours over links.
    bool has_links() const { return program.domain.model || is_tissue(); }
    /// Whether some cells of the grid are outside of the domain.
    bool has_mask() const {
        return program.domain.mask && extent == Extent::domain && !is_tissue();
    }
    /// Whether rules give values, slopes or fluxes at the border of the mask.
    bool has_values_at_border() const;
    /// The grid of the cells. For crawling cells, it is a grid of arbitrary size.
    const Grid& grid() const;
};

/// The context of a stage's starting values, and the context of its steps.
PassContext context_of_start(const Program& program, std::uint32_t stage);
PassContext context_of_steps(const Program& program, std::uint32_t stage);

/// The base of a pass. It goes through the nodes that `roots` need, operands first, and replaces
/// each node by nodes of a new graph.
class GraphPass {
public:
    GraphPass(const Expressions& from, const PassContext& context)
        : from_(from), context_(context) {}
    virtual ~GraphPass() = default;

    Expressions run();

protected:
    /// The replacement of a node whose operands are already nodes of the new graph.
    virtual NodeId image_of(const Node& node) = 0;
    /// Copies a node, together with the place where it was written in the script.
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

// The passes of lowering. lower_expressions.cpp lists them in order.
Expressions lay_on_tissue(const Expressions& from, const PassContext& context);
Expressions write_out_tensors(const Expressions& from, const PassContext& context);
Expressions lay_on_surface(const Expressions& from, const PassContext& context);
Expressions write_out_stencils(const Expressions& from, const PassContext& context);
Expressions write_out_limiters(const Expressions& from, const PassContext& context);
Expressions write_out_shifts(const Expressions& from, const PassContext& context);
Expressions find_beyond_border(const Expressions& from, const PassContext& context);
Expressions spread_over_links(const Expressions& from, const PassContext& context);
Expressions take_out_even_weights(const Expressions& from, const PassContext& context);
Expressions weigh_by_areas(const Expressions& from, const PassContext& context);
Expressions leave_out_masked_cells(const Expressions& from, const PassContext& context);
Expressions fuse_products(const Expressions& from, const PassContext& context);

/// Finds the nodes that are the same in all cells.
IdVector<NodeId, bool> uniform_nodes(const ExpressionGraph& graph, const PassContext& context);

/// Whether a node may differ from step to step even if its operands do not. Parameters and items of
/// earlier stages do not differ, because parameters keep their starting values, and earlier stages
/// have ended.
bool changes_by_itself(const Node& node, const PassContext& context);

/// Turns `value`, a derivative along the outward unit normal of a side, into the difference between
/// the cells on both sides of the face. Without a surface, the difference equals the derivative. On
/// a surface, the difference also depends on the length of the cell, and rows and columns must meet
/// at right angles at the side.
NodeId across_side(ExpressionGraph& graph, const PassContext& context, NodeId value, Side side);

}  // namespace cascade::lowering
