// Operators on a surface: what they measure there, written as parts in columns and rows.
//
// p, q and r are the entries 11, 12 and 22 of Ṽ⁻¹, s is the area of the cell (surface/
// parameter_surface.h). A gradient on the surface is Ṽ⁻ᵀ∇. What flows through the faces of a cell
// is s Ṽ⁻¹ times the flux: vectors are kept in that form, so that their differences are what they
// are on the plane, and a gradient is a tensor times ∇. Spec/surfaces.md has the formulas.
#include "lang/lower/part_graph.h"

#include "core/check.h"

#include <algorithm>

namespace cascade::lowering {

PartId PartGraph::metric(MetricPlane plane) {
    Part part;
    part.node.kind = NodeKind::metric;
    part.node.index = static_cast<std::uint32_t>(plane);
    return intern(part);
}

PartId PartGraph::sum_of_products(PartId a, PartId b, PartId c, PartId d) {
    return call(Function::add,
                {call(Function::multiply, {a, b}), call(Function::multiply, {c, d})});
}

/// Ṽ⁻¹ A Ṽ⁻ᵀ: what A is in columns and rows.
PartId PartGraph::in_cells(PartId tensor) {
    const auto [a11, a12, a22] = std::array{parts_[tensor].operands[0], parts_[tensor].operands[1],
                                            parts_[tensor].operands[2]};
    const PartId p = metric(MetricPlane::inverse_11);
    const PartId q = metric(MetricPlane::inverse_12);
    const PartId r = metric(MetricPlane::inverse_22);
    const auto times = [&](PartId a, PartId b) { return call(Function::multiply, {a, b}); };
    const PartId first = sum_of_products(p, a11, q, a12);  // The first row of Ṽ⁻¹ A.
    const PartId second = sum_of_products(p, a12, q, a22);
    return call(Function::tensor,
                {sum_of_products(first, p, second, q), times(second, r), times(times(r, r), a22)},
                ValueType::tensor);
}

/// s Ṽ⁻¹ A Ṽ⁻ᵀ: times ∇e it is what flows of the flux A grad(e).
PartId PartGraph::flow_tensor(PartId tensor) {
    const PartId cells = in_cells(tensor);
    const std::array<PartId, most_operands> entries = parts_[cells].operands;
    const PartId area = metric(MetricPlane::area);
    const auto scaled = [&](PartId entry) { return call(Function::multiply, {area, entry}); };
    return call(Function::tensor, {scaled(entries[0]), scaled(entries[1]), scaled(entries[2])},
                ValueType::tensor);
}

/// What flows of grad(e).
PartId PartGraph::flow_of_gradient(PartId gradient) {
    const PartId tensor = call(Function::tensor,
                               {metric(MetricPlane::flow_11), metric(MetricPlane::flow_12),
                                metric(MetricPlane::flow_22)},
                               ValueType::tensor);
    const PartId flow = call(Function::multiply, {tensor, gradient}, ValueType::vector);
    flows_[flow] = {gradient, std::nullopt};
    return flow;
}

/// What flows of vector(along, across), both on the surface.
PartId PartGraph::flow_of_vector(PartId along, PartId across) {
    const PartId area = metric(MetricPlane::area);
    const auto times = [&](PartId a, PartId b) { return call(Function::multiply, {a, b}); };
    const PartId column = sum_of_products(metric(MetricPlane::inverse_11), along,
                                          metric(MetricPlane::inverse_12), across);
    const PartId row = times(metric(MetricPlane::inverse_22), across);
    const PartId flow =
        call(Function::vector, {times(area, column), times(area, row)}, ValueType::vector);
    flows_[flow] = {along, across};
    return flow;
}

/// What flows of A v, where `flow` is what flows of v: A goes to the gradients and vectors that v
/// is made of. Parts come before what reads them, so that their order is one to build in.
PartId PartGraph::flow_times_tensor(PartId tensor, PartId flow) {
    std::vector<PartId> reached{flow};
    std::unordered_map<PartId, PartId> images{{flow, flow}};
    for (std::size_t k = 0; k < reached.size(); ++k) {
        const Part& part = parts_[reached[k]];
        if (flows_.contains(reached[k])) continue;
        for (std::uint32_t i = 0; i < part.operand_count; ++i) {
            const PartId operand = part.operands[i];
            if (parts_[operand].node.type != ValueType::vector) continue;
            if (images.try_emplace(operand, operand).second) reached.push_back(operand);
        }
    }
    std::sort(reached.begin(), reached.end());
    const std::array<PartId, most_operands> a = parts_[tensor].operands;
    for (const PartId id : reached) {
        if (const auto known = flows_.find(id); known != flows_.end()) {
            const auto [first, second] = known->second;
            images[id] =
                second ? flow_of_vector(sum_of_products(a[0], first, a[1], *second),
                                        sum_of_products(a[1], first, a[2], *second))
                       : call(Function::multiply, {flow_tensor(tensor), first}, ValueType::vector);
            continue;
        }
        Part part = parts_[id];
        for (std::uint32_t i = 0; i < part.operand_count; ++i) {
            PartId& operand = part.operands[i];
            if (parts_[operand].node.type == ValueType::vector) operand = images.at(operand);
        }
        images[id] = intern(part);
    }
    return images.at(flow);
}

/// The derivatives along the two directions of the tangent plane.
PartId PartGraph::along_row(PartId of) {
    return call(Function::multiply, {metric(MetricPlane::inverse_11), call(Function::dx, {of})});
}

PartId PartGraph::across_row(PartId of) {
    return sum_of_products(metric(MetricPlane::inverse_12), call(Function::dx, {of}),
                           metric(MetricPlane::inverse_22), call(Function::dy, {of}));
}

/// The derivative over √g, g being the entry of Ṽ⁻¹Ṽ⁻ᵀ on the diagonal: that of the cell, since
/// coefficients of flows are mirrored as well, and so what flows is the derivative times the length
/// of the face.
PartId PartGraph::across_side(PartId value, Side side) {
    if (!has_metric_) return value;
    const PartId p = metric(MetricPlane::inverse_11), q = metric(MetricPlane::inverse_12);
    const PartId r = metric(MetricPlane::inverse_22);
    const bool is_column = side == Side::left || side == Side::right;
    const PartId diagonal =
        is_column ? sum_of_products(p, p, q, q) : call(Function::multiply, {r, r});
    return call(Function::divide, {value, call(Function::sqrt, {diagonal})});
}

PartId PartGraph::on_surface(const Part& part) {
    const PartId first = part.operands[0];
    const PartId area = metric(MetricPlane::area);
    const auto per_area = [&](PartId flow) {
        return call(Function::divide, {call(Function::div, {flow}), area});
    };
    switch (part.node.function) {
        case Function::lap:
            return per_area(flow_of_gradient(call(Function::grad, {first}, ValueType::vector)));
        case Function::div: return per_area(first);
        case Function::grad: return flow_of_gradient(intern(part));
        case Function::vector: return flow_of_vector(first, part.operands[1]);
        case Function::dx: return along_row(first);
        case Function::dy: return across_row(first);
        case Function::grad2: {
            const PartId along = along_row(first);
            const PartId across = across_row(first);
            return sum_of_products(along, along, across, across);
        }
        case Function::advect: {
            const PartId across = part.operands[1];
            const PartId column = sum_of_products(metric(MetricPlane::inverse_11), first,
                                                  metric(MetricPlane::inverse_12), across);
            const PartId row = call(Function::multiply, {metric(MetricPlane::inverse_22), across});
            return call(Function::advect, {column, row, part.operands[2]});
        }
        case Function::diffuse: return call(Function::diffuse, {in_cells(first), part.operands[1]});
        case Function::domain_sum:
            return call(Function::domain_sum, {call(Function::multiply, {first, area})});
        case Function::domain_mean:
            return call(Function::divide,
                        {call(Function::domain_sum, {call(Function::multiply, {first, area})}),
                         call(Function::domain_sum, {area})});
        default: break;
    }
    const bool by_tensor =
        part.calls(Function::multiply) && parts_[first].node.type == ValueType::tensor;
    return by_tensor ? flow_times_tensor(first, part.operands[1]) : intern(part);
}

}  // namespace cascade::lowering
