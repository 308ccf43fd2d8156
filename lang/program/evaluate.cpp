// One loop over the flat list of nodes, in which operands come first.
#include "lang/program/evaluate.h"

#include "core/check.h"
#include "lang/program/fold.h"

#include <algorithm>

namespace cascade {

double evaluate(const Formula& formula, const BuiltinValues& builtins) {
    IdVector<NodeId, double> values;
    values.reserve(formula.nodes.size());
    for (const Node& node : formula.nodes) {
        switch (node.kind) {
            case NodeKind::number: values.push_back(node.number); break;
            case NodeKind::builtin: values.push_back(builtins[node.index]); break;
            case NodeKind::call: {
                std::array<double, most_operands> operands{};
                std::ranges::transform(node.reads(), operands.begin(),
                                       [&](NodeId operand) { return values[operand]; });
                const auto value = fold(node.function, operands);
                CHECK(value, "a formula of a place is made of functions of numbers");
                values.push_back(*value);
                break;
            }
            default: CHECK(false, "a formula of a place reads no item");
        }
    }
    return values.back();
}

}  // namespace cascade
