// Operators on the cells of a model, which have links to their neighbours instead of rows and
// columns.
//
// Operators are sums over links (ir/operations.def). A flux is known as the flow through each link.
// Vectors are sums of gradients times numbers, and div takes each term by itself: div(a * grad(e))
// is lap(a, e), the sum over the links of w (a_i + a_j) / 2 (e_j - e_i). A vector of components is
// such a sum, too, for it is vx grad(x) + vy grad(y) + vz grad(z): through a link flows the mean of
// both cells along the straight line from one to the other. A tensor leaves a part of a vector as
// it is and makes components of the rest. Spec/models.md has the formulas.
#include "lang/lower/graph_passes.h"

#include "core/check.h"
#include "lang/program/field_vectors.h"
#include "lang/program/models.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

namespace cascade::lowering {

namespace {

class ModelOperators : public GraphPass {
    using GraphPass::GraphPass;

    /// A vector as a sum of gradients of numbers, each times a number.
    using Gradients = std::vector<std::pair<NodeId, NodeId>>;  ///< Of, factor.
    using Components = std::array<NodeId, 3>;

    static constexpr std::array places{ModelPlane::place_x, ModelPlane::place_y,
                                       ModelPlane::place_z};

    /// A vector as such a sum, from those of its operands. Gradients of the same value are merged.
    Gradients sum_of_gradients(const Node& node) {
        const Node& written = old()[at()];
        const auto gradients_of = [&](std::size_t k) { return gradients_.at(written.operands[k]); };
        const NodeId first = node.operands[0], second = node.operands[1];
        if (node.function == Function::grad) return {{first, graph().number(1)}};
        if (node.function == Function::vector) return of_components(node.reads());
        const bool is_vector = old()[written.operands[0]].type == ValueType::vector;
        Gradients sum = gradients_of(is_vector ? 0 : 1);
        if (old()[written.operands[0]].type == ValueType::tensor) return turned(first, sum);
        switch (node.function) {
            case Function::negate:
                for (auto& [of, factor] : sum) factor = call(Function::negate, {factor});
                return sum;
            case Function::divide:
                for (auto& [of, factor] : sum) factor = call(Function::divide, {factor, second});
                return sum;
            case Function::multiply:
                for (auto& [of, factor] : sum) {
                    const NodeId by = is_vector ? second : first;
                    factor = graph().is_number(factor, 1) ? by : times(by, factor);
                }
                return sum;
            case Function::add:
            case Function::subtract:
                for (const auto& [of, factor] : gradients_of(1)) {
                    const auto known = std::ranges::find(sum, of, &Gradients::value_type::first);
                    if (known != sum.end()) {
                        known->second = call(node.function, {known->second, factor});
                    } else if (node.function == Function::add) {
                        sum.emplace_back(of, factor);
                    } else {
                        sum.emplace_back(of, call(Function::negate, {factor}));
                    }
                }
                return sum;
            default: break;
        }
        CHECK(false, "lowering: a flux on a model is made of gradients");
        return sum;
    }

    Gradients of_components(std::span<const NodeId> components) {
        Gradients sum;
        for (std::size_t k = 0; k < components.size(); ++k) {
            if (graph().is_number(components[k], 0)) continue;
            sum.emplace_back(graph().leaf(places[k]), components[k]);
        }
        return sum;
    }

    /// The components of a vector in the cell itself.
    Components in_cell(const Gradients& gradients) {
        constexpr std::array derivatives{Function::dx, Function::dy, Function::dz};
        std::array<std::optional<NodeId>, 3> sums;
        const auto add = [&](std::size_t k, NodeId term) {
            sums[k] = sums[k] ? call(Function::add, {*sums[k], term}) : term;
        };
        for (const auto& [of, factor] : gradients) {
            const auto* const plane = graph()[of].as<ModelPlane>();
            const auto place = plane ? std::ranges::find(places, *plane) : places.end();
            if (place != places.end()) {
                add(static_cast<std::size_t>(place - places.begin()), factor);
                continue;
            }
            const NodeId by = factor;  // The graph may move.
            const NodeId value = of;
            for (std::size_t k = 0; k < 3; ++k) {
                const NodeId slope = call(derivatives[k], {value});
                add(k, graph().is_number(by, 1) ? slope : times(by, slope));
            }
        }
        const NodeId zero = graph().number(0);
        return {sums[0].value_or(zero), sums[1].value_or(zero), sums[2].value_or(zero)};
    }

    /// A tensor times a vector.
    Gradients turned(NodeId tensor, Gradients vector) {
        const Components v = in_cell(vector);
        const ModelTensor by = model_tensor(graph(), tensor);
        std::optional<NodeId> along;
        for (std::size_t k = 0; k < 3; ++k) {
            const NodeId term = times(by.t[k], v[k]);
            along = along ? call(Function::add, {*along, term}) : term;
        }
        const NodeId size = times(by.along, *along);
        Components parts;
        for (std::size_t k = 0; k < 3; ++k) {
            parts[k] = call(Function::add, {times(by.rest, v[k]), times(size, by.t[k])});
        }
        for (auto& [of, factor] : vector) {
            factor = graph().is_number(factor, 1) ? by.low : times(by.low, factor);
        }
        for (const auto& term : of_components(parts)) add_to(vector, term);
        return vector;
    }

    /// Adds a term to a sum, or its factor to that of the same gradient.
    void add_to(Gradients& sum, const std::pair<NodeId, NodeId>& term) {
        const auto known = std::ranges::find(sum, term.first, &Gradients::value_type::first);
        if (known == sum.end()) return sum.push_back(term);
        known->second = call(Function::add, {known->second, term.second});
    }

    NodeId divergence(const Gradients& gradients) {
        if (gradients.empty()) return graph().number(0);
        std::optional<NodeId> sum;
        for (const auto& [of, factor] : gradients) {
            const NodeId term = call(Function::lap, {factor, of});
            sum = sum ? call(Function::add, {*sum, term}) : term;
        }
        return *sum;
    }

    NodeId image_of(const Node& node) override {
        if (const auto* builtin = node.as<Builtin>()) {
            const auto plane = model_plane_of(*builtin);
            return plane ? graph().leaf(*plane) : keep(node);
        }
        if (node.type == ValueType::vector) {
            gradients_.emplace(at(), sum_of_gradients(node));
            return NodeId{};  // Only div reads it.
        }
        if (node.calls(Function::div)) return divergence(gradients_.at(old()[at()].operands[0]));
        return keep(node);
    }

    std::unordered_map<NodeId, Gradients> gradients_;  ///< By vector of the old graph.
};

}  // namespace

Expressions spread_over_links(const Expressions& from, const PassContext& context) {
    return ModelOperators(from, context).run();
}

}  // namespace cascade::lowering
