// Rewrites operators for the cells of a model, which have links to their neighbours instead of rows
// and columns.
//
// Operators become sums over links (ir/operations.def). A flux is given by the flow through each
// link. Vectors are sums of gradients, each multiplied by a number, and div takes each term
// separately: div(a * grad(e)) is lap(a, e), the sum over the links of w (a_i + a_j) / 2 (e_j -
// e_i). A vector given by components is such a sum, too: vx grad(x) + vy grad(y) + vz grad(z). The
// flow of this sum through a link is the mean of the vectors in the two cells, in the direction of
// the straight line between the cells. A tensor times a vector is the sum of a part that is a
// multiple of the vector and a part that is computed by components. spec/models.md has the
// formulas.
#include "lang/lower/graph_passes.h"

#include "core/check.h"
#include "lang/program/field_vectors.h"
#include "lang/program/models.h"
#include "lang/program/vector_functions.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

namespace cascade::lowering {

namespace {

class ModelOperators : public GraphPass {
    using GraphPass::GraphPass;

    /// A vector as a sum of gradients of numbers, each multiplied by a number.
    using Gradients = std::vector<std::pair<Term, Term>>;  ///< The number whose gradient it is,
                                                           ///< then the factor.

    static constexpr std::array places{ModelPlane::place_x, ModelPlane::place_y,
                                       ModelPlane::place_z};

    /// Computes the gradients of a vector from the gradients of its operands, which are nodes of
    /// the old graph.
    struct Rules {
        ModelOperators& pass;

        const Gradients& of(NodeId vector) const { return pass.gradients_.at(vector); }
        Term number(NodeId old) const { return pass.term(pass.image(old)); }

        Gradients gradient(NodeId of) const { return {{number(of), pass.leaf(1.0)}}; }
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
            return with_factors(of(vector), [&](Term factor) { return factor / number(by); });
        }
        Gradients product(NodeId a, NodeId b, bool is_vector_first) const {
            const Term by = number(is_vector_first ? b : a);
            return with_factors(of(is_vector_first ? a : b),
                                [&](Term factor) { return factor.is(1) ? by : by * factor; });
        }
        Gradients turned(NodeId tensor, NodeId vector) const {
            return pass.turned(pass.image(tensor), of(vector));
        }
    };

    template <typename Change>
    static Gradients with_factors(Gradients gradients, const Change& change) {
        for (auto& [of, factor] : gradients) factor = change(factor);
        return gradients;
    }

    Gradients of_components(std::span<const Term> components) {
        Gradients sum;
        for (std::size_t k = 0; k < components.size(); ++k) {
            if (!components[k].is(0)) sum.emplace_back(leaf(places[k]), components[k]);
        }
        return sum;
    }

    static void add_to(std::optional<Term>& sum, Term term) { sum = sum ? *sum + term : term; }

    /// The components of a vector in the cell itself.
    TermVector in_cell(const Gradients& gradients) {
        std::array<std::optional<Term>, 3> sums;
        for (const auto& [of, factor] : gradients) {
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

    /// A tensor multiplied by a vector.
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
        for (auto& [of, factor] : vector) {
            factor = factor.is(1) ? by.low : by.low * factor;
        }
        for (const auto& term : of_components(parts)) add_to(vector, term, Function::add);
        return vector;
    }

    /// Adds a term to a sum, or subtracts it. Gradients of the same number are merged.
    void add_to(Gradients& sum, const std::pair<Term, Term>& term, Function function) {
        const auto known =
            std::ranges::find(sum, term.first.id, [](const auto& each) { return each.first.id; });
        const bool is_known = known != sum.end();
        if (is_known) known->second = Term::call(function, known->second, term.second);
        else sum.emplace_back(term.first, function == Function::add ? term.second : -term.second);
    }

    NodeId divergence(const Gradients& gradients) {
        std::optional<Term> sum;
        for (const auto& [of, factor] : gradients) add_to(sum, lap(factor, of));
        return sum ? *sum : leaf(0.0);
    }

    NodeId image_of(const Node& node) override {
        if (const auto* builtin = node.as<Builtin>()) {
            const auto plane = model_plane_of(*builtin);
            return plane ? graph().leaf(*plane) : keep(node);
        }
        if (node.type == ValueType::vector) {
            gradients_.emplace(at(), vector_by(Rules{*this}, old(), old()[at()]));
            return NodeId{};  // Only div reads vectors.
        }
        if (node.calls(Function::div)) return divergence(gradients_.at(old()[at()].operands[0]));
        return keep(node);
    }

    std::unordered_map<NodeId, Gradients> gradients_;  ///< For each vector of the old graph.
};

}  // namespace

Expressions spread_over_links(const Expressions& from, const PassContext& context) {
    return ModelOperators(from, context).run();
}

}  // namespace cascade::lowering
