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
    Term without_error(Term a, double n, Term b) {
        const double h = context().grid().spacing;
        return a - leaf(h * h / n) * b;
    }

    Term laplacian(const Node& node) {
        Node small = node;
        small.function = Function::isotropic;
        const Term isotropic = term(keep(small));
        if (!is_fourth()) return isotropic;
        const Term inner = lap(term(node.operands[0]));
        return without_error(isotropic, 12, lap(inner));
    }

    Term along(int axis, Term of) {
        const auto k = static_cast<std::size_t>(axis);
        const auto first = [&](Term e) { return Term::call(first_derivatives[k], e); };
        const Term error = first(Term::call(second_derivatives[k], of));
        return without_error(first(of), 6, error);
    }

    Term second(int axis, Term of) {
        const auto second_along = second_derivatives[static_cast<std::size_t>(axis)];
        const Term inner = Term::call(second_along, of);
        return without_error(inner, 12, Term::call(second_along, inner));
    }

    Term squared_gradient(Term of) {
        const Stencil stencil = context().grid().stencil();
        const std::array has_axis{stencil.x, stencil.y, stencil.z};
        SparseTerm sum{leaf(0.0)};
        for (int axis = 0; axis < 3; ++axis) {
            if (has_axis[static_cast<std::size_t>(axis)]) {
                sum = sum + SparseTerm{square(along(axis, of))};
            }
        }
        return sum.term;
    }

    NodeId image_of(const Node& node) override {
        if (node.calls(Function::lap)) return laplacian(node);
        if (!is_fourth()) return keep(node);
        const Term of = term(node.operands[0]);
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
