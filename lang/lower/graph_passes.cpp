// The traversal that all passes share, and the small passes.
#include "lang/lower/graph_passes.h"

#include "lang/program/models.h"

#include <algorithm>
#include <array>
#include <limits>

namespace cascade::lowering {

namespace {

/// Replaces tensor(a1, a2, theta) and symmetric(…) by a tensor of entries; diffuse takes a tensor.
class Tensors : public GraphPass {
    using GraphPass::GraphPass;

    NodeId tensor(NodeId a1, NodeId a2, NodeId theta) {
        const auto [a11, a12, a22] = tensor_entries(graph(), a1, a2, theta);
        return call(Function::tensor, {a11, a12, a22}, ValueType::tensor);
    }

    NodeId image_of(const Node& node) override {
        const auto& [a, b, c, d, e, f] = node.operands;
        if (node.calls(Function::tensor)) return tensor(a, b, c);
        if (node.calls(Function::symmetric)) {
            Node entries = node;
            entries.function = Function::tensor;
            return keep(entries);
        }
        if (!node.calls(Function::diffuse)) return keep(node);
        Node diffuse = node;
        diffuse.operands = {tensor(b, c, d), a};
        diffuse.operand_count = 2;
        return keep(diffuse);
    }
};

/// Writes transport out: along each axis the upwind difference of e, and half of that of the slopes
/// of e between cells, which are limited. The values at faces are thus those of the scheme MUSCL, e
/// plus or minus half of the slope on the side where it flows from.
class Limiters : public GraphPass {
    using GraphPass::GraphPass;

    NodeId along(Function function, int axis, std::initializer_list<NodeId> operands) {
        Node node;
        node.kind = Call{static_cast<std::uint8_t>(axis)};
        node.function = function;
        std::ranges::copy(operands, node.operands.begin());
        node.operand_count = static_cast<std::uint8_t>(operands.size());
        return graph().add(node);
    }

    NodeId image_of(const Node& node) override {
        if (!node.calls(Function::transport)) return keep(node);
        const NodeId of = node.reads().back();
        const NodeId zero = graph().number(0);
        const Stencil stencil = context().grid().stencil();
        const std::array has_axis{stencil.x, stencil.y, stencil.z};
        NodeId sum = zero;
        for (int axis = 0; axis + 1 < node.operand_count; ++axis) {
            if (!has_axis[static_cast<std::size_t>(axis)]) continue;
            const NodeId velocity = node.operands[static_cast<std::size_t>(axis)];
            const NodeId half = call(Function::if_, {call(Function::less, {zero, velocity}),
                                                     graph().number(0.5), graph().number(-0.5)});
            const NodeId slope = along(Function::limited, axis, {of});
            const NodeId first = along(Function::upwind, axis, {velocity, of});
            const NodeId second = along(Function::upwind, axis, {velocity, slope});
            const NodeId term = call(Function::add, {first, times(half, second)});
            sum = graph().is_number(sum) ? term : call(Function::add, {sum, term});
        }
        return sum;
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
        return times(node.operands[0], call(Function::lap, {node.operands[1]}));
    }

    IdVector<NodeId, bool> is_uniform_;
};

/// Weights aggregates by the areas of cells.
class Areas : public GraphPass {
    using GraphPass::GraphPass;

    NodeId image_of(const Node& node) override {
        const bool is_mean = node.calls(Function::domain_mean);
        if (!is_mean && !node.calls(Function::domain_sum)) return keep(node);
        const NodeId area = context().has_links() ? graph().leaf(ModelPlane::area)
                                                  : graph().leaf(MetricPlane::area);
        const auto sum = [&](NodeId of) { return call(Function::domain_sum, {of}); };
        const NodeId integral = sum(times(node.operands[0], area));
        return is_mean ? call(Function::divide, {integral, sum(area)}) : integral;
    }
};

/// Replaces the operand of an aggregate or a convolution outside of the mask by a value without
/// effect.
class MaskedAggregates : public GraphPass {
    using GraphPass::GraphPass;

    NodeId image_of(const Node& node) override {
        if (!is_aggregate(node) && !is_nonlocal(node)) return keep(node);
        const bool is_least = node.function == Function::domain_min;
        const bool adds = !is_least && node.function != Function::domain_max;
        const Node& of = graph()[node.operands[0]];
        const bool is_item = of.is<ItemId>() || of.is<StageItem>();
        // Items that vary are 0 outside.
        if (adds && is_item && differs_by_cell(of, false, context().program, context().stage)) {
            return keep(node);
        }
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Node masked = node;
        masked.operands[0] = call(Function::if_, {graph().leaf(InsideMask()), node.operands[0],
                                                  graph().number(adds       ? 0
                                                                 : is_least ? infinity
                                                                            : -infinity)});
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
    return {program, stage, Extent::domain, program.domain.fast};
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
