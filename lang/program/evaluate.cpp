// Evaluates formulas in one loop over their lists of nodes, in which operands come before the nodes
// that read them.
#include "lang/program/evaluate.h"

#include "core/check.h"

#include <algorithm>
#include <vector>

namespace cascade {

void evaluate(const Formula& formula, const KnownValues& known, std::span<double> values) {
    const std::size_t places = values.size();
    // One column for each node, except for the last node, whose values go into `values`.
    std::vector<double> columns((formula.nodes.size() - 1) * places);
    for (const NodeId id : formula.nodes.ids()) {
        const Node& node = formula.nodes[id];
        const bool is_last = id.index() + 1 == formula.nodes.size();
        const std::span<double> own =
            is_last ? values : std::span(columns).subspan(id.index() * places, places);
        if (const auto* const number = node.as<double>()) {
            std::ranges::fill(own, *number);
            continue;
        }
        OperandColumns operands;
        operands.fill(own.data());
        std::ranges::transform(node.reads(), operands.begin(), [&](NodeId operand) {
            return columns.data() + operand.index() * places;
        });
        const bool has_values =
            known(node, operands, own) || (node.is<Call>() && fold(node.function, operands, own));
        CHECK(has_values, "a formula of a place is made of known values and functions of numbers");
    }
}

double evaluate(const Formula& formula, const BuiltinValues& builtins) {
    double value = 0;
    const KnownValues known = [&](const Node& node, const auto&, std::span<double> values) {
        const auto* const builtin = node.as<Builtin>();
        if (builtin == nullptr) return false;
        values[0] = builtins[static_cast<std::size_t>(*builtin)];
        return true;
    };
    evaluate(formula, known, {&value, 1});
    return value;
}

}  // namespace cascade
