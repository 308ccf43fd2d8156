// Operators on the cells of a model, which have links to their neighbours instead of rows and
// columns.
//
// Operators are sums over links (ir/operations.def). A flux is known as the flow through each link.
// Vectors are therefore sums of gradients times numbers, and div takes each term by itself: div(a *
// grad(e)) is lap(a, e), the sum over the links of w (a_i + a_j) / 2 (e_j - e_i). Spec/models.md
// has the formulas, and lang/check/check_model.cpp refuses everything else.
#include "lang/lower/graph_passes.h"

#include "core/check.h"
#include "lang/program/models.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace cascade::lowering {

namespace {

class ModelOperators : public GraphPass {
    using GraphPass::GraphPass;

    /// A vector as a sum of gradients of numbers, each times a number.
    using Gradients = std::vector<std::pair<NodeId, NodeId>>;  ///< Of, factor.

    /// A vector as such a sum, from those of its operands. Gradients of the same value are merged.
    Gradients sum_of_gradients(const Node& node) {
        const Node& written = old()[at()];
        const auto gradients_of = [&](std::size_t k) { return gradients_.at(written.operands[k]); };
        const NodeId first = node.operands[0], second = node.operands[1];
        if (node.function == Function::grad) return {{first, graph().number(1)}};
        const bool is_vector = old()[written.operands[0]].type == ValueType::vector;
        Gradients sum = gradients_of(is_vector ? 0 : 1);
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

    NodeId divergence(const Gradients& gradients) {
        std::optional<NodeId> sum;
        for (const auto& [of, factor] : gradients) {
            const NodeId term = call(Function::lap, {factor, of});
            sum = sum ? call(Function::add, {*sum, term}) : term;
        }
        CHECK(sum, "lowering: a flux has a gradient");
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
