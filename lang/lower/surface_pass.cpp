// Rewrites operators on a surface as operations along columns and rows.
//
// In this file, p, q and r are the entries 11, 12 and 22 of Ṽ⁻¹, and s is the area of the cell
// (surface/parameter_surface.h). A gradient on the surface is Ṽ⁻ᵀ∇. The flow through the faces of a
// cell is s Ṽ⁻¹ times the flux. Vectors are represented by their flows. So the divergence of a
// vector is computed as on a plane, and the flow of a gradient is a tensor times ∇.
// spec/surfaces.md has the formulas.
#include "lang/lower/graph_passes.h"
#include "lang/vocabulary/function_groups.h"

#include <optional>
#include <utility>

namespace cascade::lowering {

namespace {

class SurfaceOperators : public GraphPass {
    using GraphPass::GraphPass;

    Term sum_of_products(Term a, Term b, Term c, Term d) {
        const Term first = a * b;
        return first + c * d;
    }
    Term p() { return leaf(MetricPlane::inverse_11); }
    Term q() { return leaf(MetricPlane::inverse_12); }
    Term r() { return leaf(MetricPlane::inverse_22); }
    Term s() { return leaf(MetricPlane::area); }

    TensorEntries entries(NodeId tensor) {
        const auto entry = [&](std::size_t k) { return term(graph()[tensor].operands[k]); };
        return {entry(0), entry(1), entry(2)};
    }

    /// Ṽ⁻¹ A Ṽ⁻ᵀ, which is A expressed in columns and rows.
    Term in_cells(NodeId of) {
        const auto [a11, a12, a22] = entries(of);
        const Term p = this->p(), q = this->q(), r = this->r();
        // `first` and `second` are the first row of Ṽ⁻¹ A.
        const Term first = sum_of_products(p, a11, q, a12);
        const Term second = sum_of_products(p, a12, q, a22);
        const Term along = sum_of_products(first, p, second, q);
        const Term mixed = second * r;
        return tensor(along, mixed, square(r) * a22);
    }

    /// s Ṽ⁻¹ A Ṽ⁻ᵀ. Multiplying this tensor by ∇e gives the flow of the flux A grad(e).
    Term flow_tensor(NodeId of) {
        const auto [a11, a12, a22] = entries(in_cells(of));
        const Term along = s() * a11, mixed = s() * a12;
        return tensor(along, mixed, s() * a22);
    }

    /// The flow of grad(e).
    Term flow_of_gradient(Term gradient) {
        const Term along = leaf(MetricPlane::flow_11), mixed = leaf(MetricPlane::flow_12);
        return tensor(along, mixed, leaf(MetricPlane::flow_22)) * gradient;
    }

    /// The flow of vector(along, across). Both components are along the surface.
    Term flow_of_vector(Term along, Term across) {
        const Term area = s(), column = in_columns(along, across), row = r() * across;
        const Term first = area * column;
        return vector(first, area * row);
    }

    /// The first component of Ṽ⁻¹ times the vector (along, across).
    Term in_columns(Term along, Term across) {
        const Term q = this->q();
        return sum_of_products(p(), along, q, across);
    }

    /// The flow of A v. Applies A to each gradient and each vector of which v consists in the old
    /// graph. In that graph nodes come before their readers, so the flows of smaller nodes are
    /// built first.
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
        const auto [a11, a12, a22] = entries(a);
        for (const NodeId id : reached.ids()) {
            if (!reached[id]) continue;
            Node node = old()[id];
            const Term first = term(image(node.operands[0]));
            const Term second = term(image(node.operands[1]));
            if (node.calls(Function::grad)) {
                const Term gradient = grad(first);
                flows[id] = flow_tensor(a) * gradient;
            } else if (node.calls(Function::vector)) {
                const Term across = sum_of_products(a12, first, a22, second);
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

    /// The derivative along the first direction in the tangent plane. across_row() takes the
    /// second.
    Term along_row(Term of) {
        const Term p = this->p();
        return p * dx(of);
    }
    Term across_row(Term of) {
        const Term down = dy(of), r = this->r();
        const Term along = dx(of);
        return sum_of_products(q(), along, r, down);
    }

    NodeId image_of(const Node& node) override {
        if (!node.is<Call>()) return keep(node);
        const Term first = term(node.operands[0]), second = term(node.operands[1]), area = s();
        if (carries(node.function)) {
            const Term column = in_columns(first, second), row = r() * second;
            return Term::call(node.function, column, row, term(node.operands[2]));
        }
        switch (node.function) {
            case Function::lap: return div(flow_of_gradient(grad(first))) / area;
            case Function::div: return div(first) / area;
            case Function::grad: return flow_of_gradient(term(keep(node)));
            case Function::vector: return flow_of_vector(first, second);
            case Function::dx: return along_row(first);
            case Function::dy: return across_row(first);
            case Function::grad2: {
                const Term along = along_row(first), across = across_row(first);
                return sum_of_products(along, along, across, across);
            }
            case Function::diffuse: return diffuse(in_cells(first), second);
            case Function::multiply:
                if (first.type() != ValueType::tensor) break;
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

/// The derivative divided by √g, where g is the diagonal entry of Ṽ⁻¹Ṽ⁻ᵀ in the cell itself. The
/// coefficients of flows are mirrored at sides, too, so the flow is the derivative multiplied by
/// the length of the face.
NodeId across_side(ExpressionGraph& graph, const PassContext& context, NodeId value, Side side) {
    if (!context.has_metric()) return value;
    const auto leaf = [&](MetricPlane plane) { return Term{&graph, graph.leaf(plane)}; };
    const Term p = leaf(MetricPlane::inverse_11), q = leaf(MetricPlane::inverse_12);
    const Term r = leaf(MetricPlane::inverse_22);
    const bool is_column = side == Side::left || side == Side::right;
    if (!is_column) return Term{&graph, value} / sqrt(square(r));
    const Term first = square(p);
    return Term{&graph, value} / sqrt(first + square(q));
}

}  // namespace cascade::lowering
