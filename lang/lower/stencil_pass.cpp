// Writes out operators for the stencils of the domain (spec/domain.md, "Stencils").
//
// The stencils are made of differences between adjacent cells, so they need no wider halo. Here, δ²
// is the second difference along an axis, divided by h². The isotropic Laplacian of nine or
// nineteen cells is lap + h²/6 Σ δ²δ², with the sum over all pairs of axes. Its error is h²/12
// lap(lap(e)). The Laplacian of fourth order is Σ (δ² − h²/12 δ²δ²), the wide second difference
// along each axis. The first derivative of fourth order is (E − W)/2h (1 − h²/6 δ²).
#include "lang/lower/graph_passes.h"

#include "core/check.h"
#include "lang/program/stencils.h"

#include <optional>

namespace cascade::lowering {

namespace {

/// The function that computes a difference along the axes `first` and `second`.
Function function_of(Difference difference, int first, int second) {
    for (std::size_t k = 0; k < function_count; ++k) {
        const auto own = difference_of(static_cast<Function>(k));
        const bool is_found =
            own && own->difference == difference && own->first == first && own->second == second;
        if (is_found) return static_cast<Function>(k);
    }
    CHECK(false, "lowering: differences of stencils have functions");
}

class StencilPass : public GraphPass {
    using GraphPass::GraphPass;

    /// A difference as the domain's stencil computes it.
    Term written(const AppliedDifference& applied, const Node& node) {
        const auto call = [&](Difference difference, Term of) {
            return Term::call(function_of(difference, applied.first, applied.second), of);
        };
        const StencilRow row = stencil_row(context().program.domain.stencil, applied.difference);
        Node base = node;
        base.function = function_of(row.base, applied.first, applied.second);
        const Term value = term(keep(base));
        if (row.error == 0) return value;
        const double h = context().grid().spacing;
        const Term error = call(row.outer, call(row.inner, term(node.operands[0])));
        return value - leaf(h * h / row.error) * error;
    }

    Term along(int axis, NodeId of) {
        Node node;
        node.kind = Call();
        node.operands = {of};
        node.operand_count = 1;
        return written({Difference::central, axis}, node);
    }

    Term squared_gradient(NodeId of) {
        SparseTerm sum{leaf(0.0)};
        for (const int axis : GridAxes(context().grid().stencil()).present) {
            sum = sum + SparseTerm{square(along(axis, of))};
        }
        return sum.term;
    }

    NodeId image_of(const Node& node) override {
        const auto applied = node.is<Call>() ? difference_of(node.function) : std::nullopt;
        if (applied && applied->difference != Difference::mixed) return written(*applied, node);
        const StencilKind stencil = context().program.domain.stencil;
        if (stencil_row(stencil, Difference::central).error == 0) return keep(node);
        if (node.calls(Function::grad2)) return squared_gradient(node.operands[0]);
        if (!applied) return keep(node);
        return along(applied->first, along(applied->second, node.operands[0]));
    }
};

}  // namespace

Expressions write_out_stencils(const Expressions& from, const PassContext& context) {
    return StencilPass(from, context).run();
}

}  // namespace cascade::lowering
