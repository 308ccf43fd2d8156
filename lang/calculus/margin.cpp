// Defines the margins of comparisons and of logic, by their names in functions.def.
#include "lang/calculus/margin.h"

#include "lang/program/terms.h"
#include "lang/vocabulary/by_name.h"

namespace cascade {

namespace {

struct Condition {
    Term value, margin;

    friend Condition greater(const Condition& a, const Condition& b) {
        return {{}, a.value - b.value};
    }
    friend Condition less(const Condition& a, const Condition& b) { return greater(b, a); }
    friend Condition greater_equal(const Condition& a, const Condition& b) { return greater(a, b); }
    friend Condition less_equal(const Condition& a, const Condition& b) { return greater(b, a); }
    friend Condition logical_and(const Condition& a, const Condition& b) {
        return {{}, min(a.margin, b.margin)};
    }
    friend Condition logical_or(const Condition& a, const Condition& b) {
        return {{}, max(a.margin, b.margin)};
    }
    friend Condition logical_not(const Condition& a) { return {{}, -a.margin}; }
};

}  // namespace

Formula margin_of(const Formula& condition) {
    ExpressionGraph graph;
    IdVector<NodeId, Condition> parts;
    for (Node node : condition.nodes) {
        const NodeId position = parts.next();
        Condition part, first, second;
        if (node.operand_count > 0) first = parts[node.operands[0]];
        if (node.operand_count > 1) second = parts[node.operands[1]];
        for (NodeId& operand : node.reads()) operand = parts[operand].value;
        if (node.is<Call>()) part = call_by_name(node.function, first, second, {});
        part.value = {&graph, graph.add(node, {0, position})};
        if (part.margin.graph == nullptr) {
            const Term one = part.value.number(1);
            part.margin = if_(part.value, one, part.value.number(-1));
        }
        parts.push_back(part);
    }
    return formula_of(graph.nodes(), parts.back().margin);
}

}  // namespace cascade
