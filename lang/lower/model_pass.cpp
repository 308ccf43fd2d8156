// Rewrites operators for the cells of a model, which have links to their neighbours instead of rows
// and columns.
//
// Operators become sums over links (ir/operations.def). A flux is given by the flow through each
// link. A vector is a sum of gradients, each multiplied by a number, and div is computed term by
// term: div(a * grad(e)) is lap(a, e), the sum over the links of w (a_i + a_j) / 2 (e_j - e_i). A
// vector given by components is such a sum, too: vx grad(x) + vy grad(y) + vz grad(z). The flow of
// this sum through a link is the component, along the straight line between the two cells, of the
// mean of their vectors. A tensor times a vector is the sum of a multiple of the vector and a part
// that is computed by components. There is one exception: if the tensor does not change and is
// multiplied by the gradient of a number that changes, the divergence is a sum over links whose
// weights are computed once: lap(tensor_weights(…), e). spec/models.md has the formulas.
#include "lang/lower/graph_passes.h"

#include "core/check.h"
#include "lang/program/calls.h"
#include "lang/program/field_vectors.h"
#include "lang/program/models.h"
#include "lang/program/vector_functions.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

namespace cascade::lowering {

namespace {

class ModelOperators : public GraphPass {
public:
    ModelOperators(const Expressions& from, const PassContext& context)
        : GraphPass(from, context), is_uniform_(uniform_nodes(from.graph, context)) {
        can_weigh_ = context.is_step &&
                     context.program.domain.model->laplacian == ModelLaplacian::finite_volumes;
        for (const Node& node : from.graph.nodes()) {
            bool changes = changes_by_itself(node, context);
            for (const NodeId operand : node.reads()) changes = changes || changes_[operand];
            changes_.push_back(changes);
            // With a constraint, tensors do not become weights, because the plans of a constraint
            // read no step-invariants of the rates.
            if (solved_constraint(node)) can_weigh_ = false;
        }
    }

private:
    /// A gradient multiplied by a number. If there is a tensor, the gradient is first multiplied by
    /// the tensor.
    struct Gradient {
        Term of;  ///< The number whose gradient it is.
        Term factor;
        bool changes = true;  ///< Whether `of` may differ from step to step.
        /// A tensor of the new graph that does not change. If it is set, `factor` is the same in
        /// all cells.
        std::optional<NodeId> tensor = {};
    };
    /// A vector as a sum of gradients.
    using Gradients = std::vector<Gradient>;

    static constexpr std::array places{ModelPlane::place_x, ModelPlane::place_y,
                                       ModelPlane::place_z};

    /// Computes the gradients of a vector from the gradients of its operands. The operands are
    /// nodes of the old graph.
    struct Rules {
        ModelOperators& pass;

        const Gradients& of(NodeId vector) const { return pass.gradients_.at(vector); }
        /// The gradients of a vector, changed if necessary so that the vector can be multiplied by
        /// the number `by`.
        Gradients before(NodeId by, NodeId vector) const {
            return pass.is_uniform_[by] ? of(vector) : pass.without_tensors(of(vector));
        }
        Term number(NodeId old) const { return pass.term(pass.image(old)); }

        Gradients gradient(NodeId of) const {
            return {{number(of), pass.leaf(1.0), pass.changes_[of]}};
        }
        Gradients components(std::span<const NodeId> each) const {
            std::vector<Term> parts;
            for (const NodeId part : each) parts.push_back(number(part));
            return pass.of_components(parts);
        }
        Gradients negative(NodeId vector) const {
            return with_factors(of(vector), [](Term factor) { return -factor; });
        }
        Gradients sum(NodeId a, NodeId b) const { return joined(a, b, Function::add); }
        Gradients difference(NodeId a, NodeId b) const { return joined(a, b, Function::subtract); }
        Gradients joined(NodeId a, NodeId b, Function function) const {
            Gradients sum = of(a);
            for (const auto& term : of(b)) pass.add_to(sum, term, function);
            return sum;
        }
        Gradients quotient(NodeId vector, NodeId by) const {
            return with_factors(before(by, vector),
                                [&](Term factor) { return factor / number(by); });
        }
        Gradients product(NodeId a, NodeId b, bool is_vector_first) const {
            const NodeId factor_of = is_vector_first ? b : a;
            const Term by = number(factor_of);
            return with_factors(before(factor_of, is_vector_first ? a : b),
                                [&](Term factor) { return factor.is(1) ? by : by * factor; });
        }
        Gradients turned(NodeId tensor, NodeId vector) const {
            if (pass.can_weigh(tensor, of(vector))) {
                Gradients weighed = of(vector);
                for (Gradient& each : weighed) each.tensor = pass.image(tensor);
                return weighed;
            }
            return pass.turned(pass.image(tensor), pass.without_tensors(of(vector)));
        }
    };

    template <typename Change>
    static Gradients with_factors(Gradients gradients, const Change& change) {
        for (Gradient& each : gradients) each.factor = change(each.factor);
        return gradients;
    }

    /// Whether a rate that reads this tensor times this vector can be computed with weights of
    /// links that are computed once.
    bool can_weigh(NodeId tensor, const Gradients& vector) const {
        const auto operands = old()[tensor].reads();
        return can_weigh_ &&
               std::ranges::none_of(operands, [&](NodeId id) { return changes_[id]; }) &&
               std::ranges::all_of(vector, [&](const Gradient& each) {
                   return each.changes && each.factor.is(1) && !each.tensor;
               });
    }

    /// The same vector as a sum of gradients without tensors: each tensor is multiplied by its
    /// gradient in the cells.
    Gradients without_tensors(const Gradients& vector) {
        Gradients sum;
        for (const Gradient& each : vector) {
            if (!each.tensor) {
                add_to(sum, each, Function::add);
                continue;
            }
            for (Gradient part : turned(*each.tensor, {{each.of, leaf(1.0), each.changes}})) {
                if (!each.factor.is(1)) part.factor = each.factor * part.factor;
                add_to(sum, part, Function::add);
            }
        }
        return sum;
    }

    Gradients of_components(std::span<const Term> components) {
        Gradients sum;
        for (std::size_t k = 0; k < components.size(); ++k) {
            if (!components[k].is(0)) sum.push_back({leaf(places[k]), components[k], false});
        }
        return sum;
    }

    static void add_to(std::optional<Term>& sum, Term term) { sum = sum ? *sum + term : term; }

    /// The components, in the cell itself, of a vector whose gradients have no tensors.
    TermVector in_cell(const Gradients& gradients) {
        std::array<std::optional<Term>, 3> sums;
        for (const auto& [of, factor, changes, no_tensor] : gradients) {
            const auto* const plane = graph()[of].as<ModelPlane>();
            const auto place = plane ? std::ranges::find(places, *plane) : places.end();
            if (place != places.end()) {
                add_to(sums[static_cast<std::size_t>(place - places.begin())], factor);
                continue;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const Term slope = Term::call(first_derivatives[k], of);
                add_to(sums[k], factor.is(1) ? slope : factor * slope);
            }
        }
        const Term zero = leaf(0.0);
        return {sums[0].value_or(zero), sums[1].value_or(zero), sums[2].value_or(zero)};
    }

    /// A tensor multiplied by a vector whose gradients have no tensors.
    Gradients turned(NodeId tensor, Gradients vector) {
        const TermVector v = in_cell(vector);
        const ModelTensor by = model_tensor(graph(), tensor);
        std::optional<Term> along;
        for (std::size_t k = 0; k < 3; ++k) add_to(along, by.t[k] * v[k]);
        const Term size = by.along * *along;
        std::array<Term, 3> parts;
        for (std::size_t k = 0; k < 3; ++k) {
            const Term rest = by.rest * v[k];
            parts[k] = rest + size * by.t[k];
        }
        vector = with_factors(std::move(vector),
                              [&](Term factor) { return factor.is(1) ? by.low : by.low * factor; });
        for (const Gradient& each : of_components(parts)) add_to(vector, each, Function::add);
        return vector;
    }

    /// Adds a gradient to a sum, or subtracts it. Gradients of the same number are merged.
    void add_to(Gradients& sum, const Gradient& add, Function function) {
        const auto known = std::ranges::find_if(sum, [&](const Gradient& each) {
            return each.of == add.of && each.tensor == add.tensor;
        });
        if (known != sum.end()) {
            known->factor = Term::call(function, known->factor, add.factor);
            return;
        }
        sum.push_back(add);
        if (function == Function::subtract) sum.back().factor = -add.factor;
    }

    /// The weights of links for tensor(a1, a2, theta). The tensor's matrix is γ + v vᵀ, where γ is
    /// the smaller of a1² and a2², and v points in the direction of the larger.
    Term weights_of(NodeId tensor) {
        const auto operand = [&](std::size_t n) { return term(graph()[tensor].operands[n]); };
        const Term first = square(operand(0)), second = square(operand(1)), theta = operand(2);
        const Term low = min(first, second), size = sqrt(abs(first - second));
        const Term is_along = second < first, cosine = cos(theta), sine = sin(theta);
        const Term right = if_(is_along, cosine, -sine), down = if_(is_along, sine, cosine);
        return tensor_weights(low, size * right, size * down);
    }

    NodeId divergence(const Gradients& gradients) {
        std::optional<Term> sum;
        for (const Gradient& each : gradients) {
            if (!each.tensor) {
                add_to(sum, lap(each.factor, each.of));
                continue;
            }
            const Term spread = lap(weights_of(*each.tensor), each.of);
            add_to(sum, each.factor.is(1) ? spread : each.factor * spread);
        }
        return sum ? *sum : leaf(0.0);
    }

    NodeId image_of(const Node& node) override {
        if (const auto* builtin = node.as<Builtin>()) {
            const auto plane = model_plane_of(*builtin);
            return plane ? graph().leaf(*plane) : keep(node);
        }
        if (node.type == ValueType::vector) {
            gradients_.emplace(at(), vector_by(Rules{*this}, old(), old()[at()]));
            return NodeId{};  // The new graph needs no node, because only div reads vectors.
        }
        if (node.calls(Function::div)) return divergence(gradients_.at(old()[at()].operands[0]));
        return keep(node);
    }

    // Facts about nodes of the old graph.

    /// `changes_` says whether a node differs from step to step.
    IdVector<NodeId, bool> is_uniform_, changes_;
    std::unordered_map<NodeId, Gradients> gradients_;  ///< The gradients of each vector.
    bool can_weigh_ = false;  ///< Whether tensors that do not change may become weights of links.
};

}  // namespace

Expressions spread_over_links(const Expressions& from, const PassContext& context) {
    return ModelOperators(from, context).run();
}

}  // namespace cascade::lowering
