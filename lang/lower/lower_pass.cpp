// Computes the values of a pass node by node. Operands come before the nodes that read them.
#include "lang/lower/lower_pass.h"

#include "core/check.h"

#include <bit>
#include <cstdlib>
#include <utility>

namespace cascade::lowering {

PlaneSource PassView::plane(NodeId id) const {
    if (planner.is_step_invariant(id)) return storage.step_invariant[id];
    if (planner.is_plane_in(id, pass)) return storage.temporary[id];
    return plane_source(graph, id);
}

std::optional<UniformSource> PassView::number(NodeId id) const {
    if (planner.is_step_invariant(id)) {
        if (graph.is_uniform(id)) return storage.step_invariant[id];
    } else if (is_aggregate(graph[id]) && !planner.is_plane_in(id, pass)) {
        return storage.aggregate[id];
    }
    return std::nullopt;
}

NodeValues::NodeValues(const PlanGraph& graph, KernelAssembly& assembly, Needs needs)
    : graph_(graph),
      assembly_(assembly),
      builder_(assembly.builder()),
      needs_(std::move(needs)),
      first_(needs_.size()) {
    std::size_t count = 0;
    for (const NodeId id : needs_.ids()) {
        first_[id] = static_cast<std::uint32_t>(count);
        count += static_cast<std::size_t>(std::popcount(needs_[id]));
    }
    values_.resize(count);
}

std::size_t NodeValues::place(NodeId id, std::uint32_t where) const {
    CHECK((needs_[id] >> where & 1) != 0, "lowering: what is read was needed");
    const std::uint32_t before = needs_[id] & ((std::uint32_t{1} << where) - 1);
    return first_[id] + static_cast<std::size_t>(std::popcount(before));
}

ValueId NodeValues::scaled(ValueId value, double factor) const {
    if (factor == 1) return value;
    return builder_.multiply(value, builder_.number(factor));
}

std::optional<ValueId> NodeValues::weighted(NodeId id, const Taps& taps, bool keeps_product,
                                            Offset from) const {
    std::optional<ValueId> sum;
    for (std::size_t k = 0; k < taps.taps.size();) {
        const int weight = taps.taps[k].weight;
        ValueId part = beside(id, from + taps.taps[k].at);
        for (++k; k < taps.taps.size() && taps.taps[k].weight == weight; ++k) {
            part = builder_.add(part, beside(id, from + taps.taps[k].at));
        }
        if (std::abs(weight) != 1) {
            part = builder_.multiply(builder_.number(std::abs(weight)), part);
            // Excluded from contraction, because operations on planes also round this product
            // before they add it. Otherwise the two would give different bits.
            if (keeps_product) builder_.keep(part);
        }
        if (!sum) sum = weight > 0 ? part : builder_.apply(Op::negate, part);
        else sum = weight > 0 ? builder_.add(*sum, part) : builder_.subtract(*sum, part);
    }
    return sum;
}

PassLowering::PassLowering(const PassView& pass, KernelAssembly& assembly,
                           std::span<const NodeId> wanted)
    : pass_(pass),
      assembly_(assembly),
      builder_(assembly.builder()),
      values_(pass.graph, assembly, needs_of(pass, wanted)),
      fluxes_(pass_, assembly, values_) {
    for (const NodeId id : pass_.graph.ids()) {
        if (values_.needs(id) != 0) compute(id);
    }
}

void PassLowering::compute(NodeId id) {
    const ValueId first = builder_.next();
    if (pass_.graph[id].type == ValueType::vector) {
        for_each_face(values_.needs(id), [&](Face face) {
            values_.slot(id, face.number()) = {fluxes_.at_face(id, face)};
        });
    } else {
        for_each_offset(values_.needs(id), [&](Offset offset) {
            const Value value = compute_at(id, offset);
            values_.slot(id, offset.number()) = value;
            // Excluded from contraction, because the value is stored in a plane or may be computed
            // again where it is read. All copies of the value must have the same bits.
            builder_.keep(value[0]);
        });
    }
    // Excluded from contraction, because another kernel may compute the step-invariant once.
    if (pass_.graph.is_step_invariant(id)) builder_.keep_from(first);
}

Value PassLowering::compute_at(NodeId id, Offset offset) {
    const PlanGraph& graph = pass_.graph;
    const Node& node = graph[id];
    if (pass_.is_source(id, only(offset))) {
        const auto number = pass_.number(id);
        return {number ? assembly_.uniform(*number) : assembly_.field(pass_.plane(id), offset)};
    }
    if (node.calls(Function::div)) return {fluxes_.divergence(node)};
    if (node.is<Call>() && is_stencil(node.function)) {
        return {lower_stencil(pass_, assembly_, values_, id)};
    }
    if (node.calls(Function::bordered)) return values_.at(node.operands[0], offset);
    NodeInCell in{graph, id, offset, {}};
    for (std::size_t k = 0; k < node.operand_count; ++k) {
        in.values[k] = values_.at(node.operands[k], offset);
    }
    return lower_node(assembly_, in);
}

}  // namespace cascade::lowering
