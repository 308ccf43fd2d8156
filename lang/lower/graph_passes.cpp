// The traversal that all passes share, and the short passes.
#include "lang/lower/graph_passes.h"

#include "lang/program/models.h"
#include "lang/program/stencils.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>

namespace cascade::lowering {

namespace {

/// Replaces tensor(a1, a2, theta) and symmetric(…) by a tensor node whose operands are the tensor's
/// entries. The operands of `diffuse` become a tensor node and the value that diffuses.
class Tensors : public GraphPass {
    using GraphPass::GraphPass;

    Term entries(NodeId a1, NodeId a2, NodeId theta) {
        const auto [a11, a12, a22] = tensor_entries(graph(), a1, a2, theta);
        return tensor(a11, a12, a22);
    }

    NodeId image_of(const Node& node) override {
        const auto& [a, b, c, d, e, f] = node.operands;
        if (node.calls(Function::tensor)) return entries(a, b, c);
        Node image = node;
        if (node.calls(Function::symmetric)) image.function = Function::tensor;
        if (node.calls(Function::diffuse)) {
            image.operands = {entries(b, c, d), a};
            image.operand_count = 2;
        }
        return keep(image);
    }
};

/// Writes transport(v, e) as a formula. Along each axis it is the upwind difference of e plus half
/// of the upwind difference of limited slopes. So the values at faces are those of the scheme
/// MUSCL: in the cell from which the flow comes, e plus or minus half of the limited slope.
class Limiters : public GraphPass {
    using GraphPass::GraphPass;

    Term along(Function function, int axis, std::initializer_list<NodeId> operands) {
        Node node;
        node.kind = Call{static_cast<std::uint8_t>(axis)};
        node.function = function;
        std::ranges::copy(operands, node.operands.begin());
        node.operand_count = static_cast<std::uint8_t>(operands.size());
        return term(graph().add(node));
    }

    NodeId image_of(const Node& node) override {
        if (!node.calls(Function::transport)) return keep(node);
        const NodeId of = node.reads().back();
        const Term zero = leaf(0.0);
        SparseTerm sum{zero};
        const Stencil stencil = context().grid().stencil();
        const std::array has_axis{stencil.x, stencil.y, stencil.z};
        for (int axis = 0; axis + 1 < node.operand_count; ++axis) {
            if (!has_axis[static_cast<std::size_t>(axis)]) continue;
            const Term velocity = term(node.operands[static_cast<std::size_t>(axis)]);
            const Term is_forwards = zero < velocity, ahead = leaf(0.5);
            const Term half = if_(is_forwards, ahead, leaf(-0.5));
            const Term slope = along(Function::limited, axis, {of});
            const Term first = along(Function::upwind, axis, {velocity, of});
            const Term second = along(Function::upwind, axis, {velocity, slope});
            sum = sum + SparseTerm{first + half * second};
        }
        return sum.term;
    }
};

/// Writes shifted(e, i, j) as steps to adjacent cells: first along x, then along y and z. Along an
/// axis with one cell there is no step.
class Shifts : public GraphPass {
    using GraphPass::GraphPass;

    Term beside(Term of, Offset at) {
        Node node;
        node.kind = Call{at.number()};
        node.function = Function::beside;
        node.operands = {of};
        node.operand_count = 1;
        return term(graph().add(node));
    }

    NodeId image_of(const Node& node) override {
        if (!node.calls(Function::shifted)) return keep(node);
        const GridAxes axes(context().grid().stencil());
        Term value = term(node.operands[0]);
        for (int axis = 0; axis + 1 < node.operand_count; ++axis) {
            const Node& shift = graph()[node.operands[static_cast<std::size_t>(axis) + 1]];
            const auto cells = static_cast<int>(*shift.as<double>());
            for (int k = 0; axes.has(axis) && k < std::abs(cells); ++k) {
                value = beside(value, Offset::along(axis, cells > 0 ? 1 : -1));
            }
        }
        return value;
    }
};

/// Turns lap(a, e) into a * lap(e) if a is the same in all cells.
class EvenWeights : public GraphPass {
public:
    EvenWeights(const Expressions& from, const PassContext& context)
        : GraphPass(from, context), is_uniform_(uniform_nodes(from.graph, context)) {}

private:
    NodeId image_of(const Node& node) override {
        const bool is_weighted = node.calls(Function::lap) && node.operand_count == 2;
        if (!is_weighted || !is_uniform_[old()[at()].operands[0]]) return keep(node);
        return term(node.operands[0]) * lap(term(node.operands[1]));
    }

    IdVector<NodeId, bool> is_uniform_;
};

/// Weights aggregates by the areas of cells.
class Areas : public GraphPass {
    using GraphPass::GraphPass;

    NodeId image_of(const Node& node) override {
        const auto kind = is_aggregate(node) ? reduction_of(node.function) : std::nullopt;
        const bool is_mean = kind == ReductionKind::mean;
        if (!is_mean && kind != ReductionKind::sum) return keep(node);
        const Term area = context().has_links() ? leaf(ModelPlane::area) : leaf(MetricPlane::area);
        const Term integral = domain_sum(term(node.operands[0]) * area);
        return is_mean ? integral / domain_sum(area) : integral;
    }
};

/// Outside the mask, gives the operand of an aggregate or a convolution a value that does not
/// change the result.
class MaskedAggregates : public GraphPass {
    using GraphPass::GraphPass;

    NodeId image_of(const Node& node) override {
        if (!is_aggregate(node) && !is_nonlocal(node)) return keep(node);
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const auto kind = reduction_of(node.function);
        const double without_effect = kind == ReductionKind::least     ? infinity
                                      : kind == ReductionKind::largest ? -infinity
                                                                       : 0;
        const Node& of = graph()[node.operands[0]];
        const bool is_item = of.is<ItemId>() || of.is<StageItem>();
        // Items that vary need no replacement, because they are 0 outside the mask.
        if (without_effect == 0 && is_item &&
            differs_by_cell(of, false, context().program, context().stage)) {
            return keep(node);
        }
        Node masked = node;
        const Term is_inside = leaf(InsideMask());
        masked.operands[0] = if_(is_inside, term(node.operands[0]), leaf(without_effect));
        return keep(masked);
    }
};

}  // namespace

const Grid& PassContext::grid() const {
    static const Grid of_tissue = rows_of_cells(1);
    return is_tissue() ? of_tissue : program.domain.grid;
}

bool PassContext::has_values_at_border() const {
    const auto has_value = [](const SideSettings& sides) {
        return takes_value(sides[static_cast<std::size_t>(Side::border)].kind);
    };
    const Stage& here = program.stages[stage];
    return has_mask() && !is_start &&
           (std::ranges::any_of(here.sides, has_value) ||
            std::ranges::any_of(here.definition_sides, has_value, &DefinitionSides::sides));
}

PassContext context_of_start(const Program& program, std::uint32_t stage) {
    return {program, stage, Extent::domain, false, true};
}

PassContext context_of_steps(const Program& program, std::uint32_t stage) {
    return {program, stage, Extent::domain, program.domain.fast, false, true};
}

bool changes_by_itself(const Node& node, const PassContext& context) {
    if (const auto* item = node.as<ItemId>()) {
        return context.program.system_of(context.stage).is_species(*item);
    }
    return node.is(Builtin::t) || node.is(Builtin::step) || is_draw(node);
}

Expressions GraphPass::run() {
    const auto needed = needed_by(from_.graph, from_.roots);
    images_.resize(needed.size());
    for (const NodeId id : needed.ids()) {
        if (!needed[id]) continue;
        Node node = from_.graph[id];
        for (NodeId& operand : node.reads()) operand = images_[operand];
        at_ = id;
        images_[id] = image_of(node);
    }
    for (const NodeId root : from_.roots) to_.roots.push_back(images_[root]);
    for (const auto& [id, name] : from_.names) {
        if (needed[id]) to_.names.emplace_back(images_[id], name);
    }
    for (const auto& [id, wall] : from_.walls) {
        if (needed[id]) to_.walls.emplace_back(images_[id], wall);
    }
    to_.origins = from_.origins;
    return std::move(to_);
}

IdVector<NodeId, bool> uniform_nodes(const ExpressionGraph& graph, const PassContext& context) {
    IdVector<NodeId, bool> is_uniform;
    is_uniform.reserve(graph.size());
    for (const Node& node : graph.nodes()) {
        bool operand_differs = false;
        for (const NodeId operand : node.reads()) operand_differs |= !is_uniform[operand];
        is_uniform.push_back(
            !differs_by_cell(node, operand_differs, context.program, context.stage));
    }
    return is_uniform;
}

Expressions write_out_tensors(const Expressions& from, const PassContext& context) {
    return Tensors(from, context).run();
}

Expressions write_out_limiters(const Expressions& from, const PassContext& context) {
    return Limiters(from, context).run();
}

Expressions write_out_shifts(const Expressions& from, const PassContext& context) {
    return Shifts(from, context).run();
}

Expressions take_out_even_weights(const Expressions& from, const PassContext& context) {
    return EvenWeights(from, context).run();
}

Expressions weigh_by_areas(const Expressions& from, const PassContext& context) {
    return Areas(from, context).run();
}

Expressions leave_out_masked_cells(const Expressions& from, const PassContext& context) {
    return MaskedAggregates(from, context).run();
}

}  // namespace cascade::lowering
