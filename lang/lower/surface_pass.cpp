// Operators on a surface, expressed in columns and rows.
//
// p, q and r are the entries 11, 12 and 22 of Ṽ⁻¹, and s is the area of the cell
// (surface/parameter_surface.h). A gradient on the surface is Ṽ⁻ᵀ∇. The flow through the faces of a
// cell is s Ṽ⁻¹ times the flux. Vectors are kept as such flows, so that their divergence is that of
// the plane, and a gradient is a tensor times ∇. Spec/surfaces.md has the formulas.
#include "lang/lower/graph_passes.h"

#include <optional>
#include <utility>

namespace cascade::lowering {

namespace {

NodeId metric(ExpressionGraph& graph, MetricPlane plane) { return graph.leaf(plane); }

class SurfaceOperators : public GraphPass {
    using GraphPass::GraphPass;

    NodeId sum_of_products(NodeId a, NodeId b, NodeId c, NodeId d) {
        return call(Function::add, {times(a, b), times(c, d)});
    }
    NodeId p() { return metric(graph(), MetricPlane::inverse_11); }
    NodeId q() { return metric(graph(), MetricPlane::inverse_12); }
    NodeId r() { return metric(graph(), MetricPlane::inverse_22); }
    NodeId s() { return metric(graph(), MetricPlane::area); }

    NodeId tensor(NodeId a11, NodeId a12, NodeId a22) {
        return call(Function::tensor, {a11, a12, a22}, ValueType::tensor);
    }

    /// Ṽ⁻¹ A Ṽ⁻ᵀ: A in terms of columns and rows.
    NodeId in_cells(NodeId of) {
        const auto [a11, a12, a22, x, y, z] = graph()[of].operands;
        const NodeId p = this->p(), q = this->q(), r = this->r();
        const NodeId first = sum_of_products(p, a11, q, a12);  // The first row of Ṽ⁻¹ A.
        const NodeId second = sum_of_products(p, a12, q, a22);
        const NodeId along = sum_of_products(first, p, second, q);
        const NodeId mixed = times(second, r);
        return tensor(along, mixed, times(times(r, r), a22));
    }

    /// s Ṽ⁻¹ A Ṽ⁻ᵀ: times ∇e it is the flow of the flux A grad(e).
    NodeId flow_tensor(NodeId of) {
        const auto [a11, a12, a22, x, y, z] = graph()[in_cells(of)].operands;
        const NodeId along = times(s(), a11), mixed = times(s(), a12);
        return tensor(along, mixed, times(s(), a22));
    }

    /// The flow of grad(e).
    NodeId flow_of_gradient(NodeId gradient) {
        const NodeId along = metric(graph(), MetricPlane::flow_11);
        const NodeId mixed = metric(graph(), MetricPlane::flow_12);
        const NodeId of = tensor(along, mixed, metric(graph(), MetricPlane::flow_22));
        return call(Function::multiply, {of, gradient}, ValueType::vector);
    }

    /// The flow of vector(along, across), with both components on the surface.
    NodeId flow_of_vector(NodeId along, NodeId across) {
        const NodeId area = s();
        const NodeId column = in_columns(along, across);
        const NodeId row = times(r(), across);
        const NodeId first = times(area, column);
        return call(Function::vector, {first, times(area, row)}, ValueType::vector);
    }

    /// The first component of Ṽ⁻¹ (along, across).
    NodeId in_columns(NodeId along, NodeId across) {
        const NodeId q = this->q();
        return sum_of_products(p(), along, q, across);
    }

    /// The flow of A v: A is applied to the gradients and vectors of which the old v is made. Nodes
    /// come before their readers, so they can be built in this order.
    NodeId flow_times_tensor(NodeId a, NodeId v) {
        IdVector<NodeId, bool> reached(v.index() + 1, false);
        IdVector<NodeId, NodeId> flows(reached.size());
        const auto is_made_of_vectors = [&](const Node& node) {
            return !node.calls(Function::grad) && !node.calls(Function::vector);
        };
        const auto is_vector = [&](NodeId id) { return old()[id].type == ValueType::vector; };
        reached[v] = true;
        for (const NodeId id : reached.ids_backwards()) {
            if (!reached[id] || !is_made_of_vectors(old()[id])) continue;
            for (const NodeId operand : old()[id].reads()) {
                if (is_vector(operand)) reached[operand] = true;
            }
        }
        const auto [a11, a12, a22, x, y, z] = graph()[a].operands;
        for (const NodeId id : reached.ids()) {
            if (!reached[id]) continue;
            Node node = old()[id];
            const NodeId first = image(node.operands[0]), second = image(node.operands[1]);
            if (node.calls(Function::grad)) {
                const NodeId gradient = call(Function::grad, {first}, ValueType::vector);
                flows[id] = call(Function::multiply, {flow_tensor(a), gradient}, ValueType::vector);
            } else if (node.calls(Function::vector)) {
                const NodeId across = sum_of_products(a12, first, a22, second);
                flows[id] = flow_of_vector(sum_of_products(a11, first, a12, second), across);
            } else {
                for (NodeId& operand : node.reads()) {
                    operand = is_vector(operand) ? flows[operand] : image(operand);
                }
                flows[id] = graph().add(node, old().written(id));
            }
        }
        return flows[v];
    }

    /// The derivatives along the two directions of the tangent plane.
    NodeId along_row(NodeId of) {
        const NodeId p = this->p();
        return times(p, call(Function::dx, {of}));
    }
    NodeId across_row(NodeId of) {
        const NodeId down = call(Function::dy, {of}), r = this->r();
        const NodeId along = call(Function::dx, {of});
        return sum_of_products(q(), along, r, down);
    }

    NodeId image_of(const Node& node) override {
        if (!node.is<Call>()) return keep(node);
        const NodeId first = node.operands[0], second = node.operands[1], area = s();
        const auto per_area = [&](NodeId flow) {
            return call(Function::divide, {call(Function::div, {flow}), area});
        };
        switch (node.function) {
            case Function::lap:
                return per_area(flow_of_gradient(call(Function::grad, {first}, ValueType::vector)));
            case Function::div: return per_area(first);
            case Function::grad: return flow_of_gradient(keep(node));
            case Function::vector: return flow_of_vector(first, second);
            case Function::dx: return along_row(first);
            case Function::dy: return across_row(first);
            case Function::grad2: {
                const NodeId along = along_row(first), across = across_row(first);
                return sum_of_products(along, along, across, across);
            }
            case Function::advect:
            case Function::transport: {
                const NodeId column = in_columns(first, second);
                const NodeId row = times(r(), second);
                return call(node.function, {column, row, node.operands[2]});
            }
            case Function::diffuse: return call(Function::diffuse, {in_cells(first), second});
            case Function::multiply:
                if (graph()[first].type != ValueType::tensor) break;
                return flow_times_tensor(first, old()[at()].operands[1]);
            default: break;
        }
        return keep(node);
    }
};

}  // namespace

Expressions lay_on_surface(const Expressions& from, const PassContext& context) {
    return SurfaceOperators(from, context).run();
}

/// The derivative over √g, where g is the diagonal entry of Ṽ⁻¹Ṽ⁻ᵀ in the cell itself. Coefficients
/// of flows are mirrored, too, so the flow is the derivative times the length of the face.
NodeId across_side(ExpressionGraph& graph, const PassContext& context, NodeId value, Side side) {
    if (!context.has_metric()) return value;
    const NodeId p = metric(graph, MetricPlane::inverse_11);
    const NodeId q = metric(graph, MetricPlane::inverse_12);
    const NodeId r = metric(graph, MetricPlane::inverse_22);
    const auto square = [&](NodeId of) { return graph.call(Function::multiply, {of, of}); };
    const bool is_column = side == Side::left || side == Side::right;
    const NodeId diagonal =
        is_column ? graph.call(Function::add, {square(p), square(q)}) : square(r);
    return graph.call(Function::divide, {value, graph.call(Function::sqrt, {diagonal})});
}

}  // namespace cascade::lowering
