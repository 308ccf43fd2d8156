// Writes operators out for the stencils of the domain (spec/domain.md, "Stencils").
//
// Both stencils are made of small differences, so that they need no wider halo: with δ² the second
// difference along an axis over h², the isotropic Laplacian of nine or nineteen cells is
// lap + h²/6 Σ δ²δ² over the pairs of axes, whose error is h²/12 lap(lap(e)). Without that error it
// is Σ (δ² − h²/12 δ²δ²), the wide second difference of fourth order along each axis. The first one
// is (E − W)/2h (1 − h²/6 δ²).
#include "lang/lower/graph_passes.h"

#include <array>

namespace cascade::lowering {

namespace {

constexpr std::array second_derivatives{Function::dxx, Function::dyy, Function::dzz};

class StencilPass : public GraphPass {
    using GraphPass::GraphPass;

    bool is_fourth() const { return context().program.domain.stencil == StencilKind::fourth; }

    /// a − h²/n b.
    NodeId without_error(NodeId a, double n, NodeId b) {
        const double h = context().grid().spacing;
        return call(Function::subtract, {a, times(graph().number(h * h / n), b)});
    }

    NodeId laplacian(const Node& node) {
        Node small = node;
        small.function = Function::isotropic;
        const NodeId isotropic = keep(small);
        if (!is_fourth()) return isotropic;
        const NodeId inner = call(Function::lap, {node.operands[0]});
        return without_error(isotropic, 12, call(Function::lap, {inner}));
    }

    NodeId along(int axis, NodeId of) {
        const auto k = static_cast<std::size_t>(axis);
        const NodeId error = call(first_derivatives[k], {call(second_derivatives[k], {of})});
        return without_error(call(first_derivatives[k], {of}), 6, error);
    }

    NodeId second(int axis, NodeId of) {
        const auto second_along = second_derivatives[static_cast<std::size_t>(axis)];
        const NodeId inner = call(second_along, {of});
        return without_error(inner, 12, call(second_along, {inner}));
    }

    NodeId squared_gradient(NodeId of) {
        const Stencil stencil = context().grid().stencil();
        const std::array has_axis{stencil.x, stencil.y, stencil.z};
        NodeId sum = graph().number(0);
        for (int axis = 0; axis < 3; ++axis) {
            if (!has_axis[static_cast<std::size_t>(axis)]) continue;
            const NodeId part = along(axis, of), square = times(part, part);
            sum = graph().is_number(sum) ? square : call(Function::add, {sum, square});
        }
        return sum;
    }

    NodeId image_of(const Node& node) override {
        if (node.calls(Function::lap)) return laplacian(node);
        if (!is_fourth()) return keep(node);
        const NodeId of = node.operands[0];
        if (node.calls(Function::grad2)) return squared_gradient(of);
        const auto [order, first, other] =
            node.is<Call>() ? derivative_of(node.function) : Derivative{};
        if (order == 1) return along(first, of);
        if (order == 2) return first == other ? second(first, of) : along(first, along(other, of));
        return keep(node);
    }
};

}  // namespace

Expressions write_out_stencils(const Expressions& from, const PassContext& context) {
    return StencilPass(from, context).run();
}

}  // namespace cascade::lowering
