// One loop over the flat list of nodes, in which operands come first.
#include "lang/program/evaluate.h"

#include "core/check.h"
#include "core/overloaded.h"
#include "lang/program/fold.h"

#include <algorithm>

namespace cascade {

double evaluate(const Formula& formula, const BuiltinValues& builtins) {
    IdVector<NodeId, double> values;
    values.reserve(formula.nodes.size());
    for (const Node& node : formula.nodes) {
        const Overloaded value{
            [](double number) { return number; },
            [&](Builtin builtin) { return builtins[static_cast<std::size_t>(builtin)]; },
            [&](Call) {
                std::array<double, most_operands> operands{};
                std::ranges::transform(node.reads(), operands.begin(),
                                       [&](NodeId operand) { return values[operand]; });
                const auto folded = fold(node.function, operands);
                CHECK(folded, "a formula of a place is made of functions of numbers");
                return *folded;
            },
            [](auto) -> double { CHECK(false, "a formula of a place reads no item"); },
        };
        values.push_back(std::visit(value, node.kind));
    }
    return values.back();
}

}  // namespace cascade
