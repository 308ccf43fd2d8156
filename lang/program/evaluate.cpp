// One loop over the flat list of nodes, in which operands come first.
#include "lang/program/evaluate.h"

#include "core/check.h"
#include "lang/program/fold.h"

#include <algorithm>

namespace cascade {

double evaluate(const Formula& formula, const KnownValue& known) {
    IdVector<NodeId, double> values;
    values.reserve(formula.nodes.size());
    for (const Node& node : formula.nodes) {
        if (const auto* const number = node.as<double>()) {
            values.push_back(*number);
            continue;
        }
        std::array<double, most_operands> operands{};
        std::ranges::transform(node.reads(), operands.begin(),
                               [&](NodeId operand) { return values[operand]; });
        std::optional<double> value = known(node, operands);
        if (!value && node.is<Call>()) value = fold(node.function, operands);
        CHECK(value, "a formula of a place is made of known values and functions of numbers");
        values.push_back(*value);
    }
    return values.back();
}

double evaluate(const Formula& formula, const BuiltinValues& builtins) {
    return evaluate(formula, [&](const Node& node, const auto&) -> std::optional<double> {
        const auto* const builtin = node.as<Builtin>();
        if (builtin == nullptr) return std::nullopt;
        return builtins[static_cast<std::size_t>(*builtin)];
    });
}

}  // namespace cascade
